"""The block of GetFEM's demonstration of continuation with contact and friction, as a scene.

A block of 40 x 80 mm, 10 x 20 elements of 4 nodes, plane strain, Ciarlet-Geymonat material, held at its upper edge, its lower edge on a
rough floor. Its sides carry dead tractions that change linearly with gamma from FIRST at 0 to -FIRST at 1, and vanish at 1/2.
Forces in N, lengths in mm, thickness 1.
"""
import contact_path as cp

WIDTH, HEIGHT, COLUMNS, ROWS = 40.0, 80.0, 10, 20
LAMBDA, MU, A = 4000.0, 120.0, 30.0  # of the material [N/mm^2]
FRICTION = 1.0
FIRST = {'left': (-2.0, -2.4), 'right': (-2.0, 2.4)}  # tractions at gamma = 0 [N/mm^2]


def name(column, row):
    return 'n%d_%d' % (column, row)


def contacts():
    """Names of the contact candidates, from left to right."""
    return [name(column, 0) + '@floor' for column in range(COLUMNS + 1)]


def scene(changes_of_gamma):
    """The block with a program: a stage that brings the tractions of gamma = 0 on, and one for each of these changes of gamma."""
    block = cp.Scene('block')
    for row in range(ROWS + 1):
        for column in range(COLUMNS + 1):
            held = row == ROWS
            block.node(name(column, row), x=WIDTH * column / COLUMNS, y=HEIGHT * row / ROWS, fixed_x=held, fixed_y=held)
    block.material('rubber', model='ciarlet_geymonat', lambda_=LAMBDA, mu=MU, a=A)
    block.solid('block', material='rubber', nodes_per_element=4, nodes=[
        name(column + dx, row + dy) for row in range(ROWS) for column in range(COLUMNS)
        for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))])
    # The material is on the right.
    block.surface('left', nodes=[name(0, row) for row in range(ROWS + 1)])
    block.surface('right', nodes=[name(COLUMNS, row) for row in reversed(range(ROWS + 1))])
    block.group('bottom', nodes=[name(column, 0) for column in range(COLUMNS + 1)])
    block.obstacle('floor', ny=1.0, friction=FRICTION)
    block.contact(group='bottom', obstacle='floor')
    for target, factor in [(1.0, 1.0)] + [(change, -2.0) for change in changes_of_gamma]:
        stage = block.stage(target=target)
        for side, (px, py) in FIRST.items():
            stage.load(surface=side, px=factor * px, py=factor * py)
    return block
