"""The branches of the block of peers_block.py from gamma = 1/2 on, by trying all combinations of contact states.

There the block has no loads, strains and forces, and all nodes of its lower edge touch the floor with slip 0 by the total law of
friction. A branch is a solution of the rate problem: linear elasticity, where the rates of gaps, slips and forces obey the laws of
contact and friction themselves. No code of the solvers is used.
"""
import numpy as np

import peers_block as block

COUNT = block.COLUMNS + 1  # contacts
STATES = 4  # open, stick, slide towards +x, slide towards -x
OPEN, STICK, PLUS, MINUS = range(STATES)
BATCH = STATES ** 7
NOTHING = 1e-9  # of the largest rate of its kind


def element_stiffness():
    """Of a rectangular element of 4 nodes, plane strain, 2 x 2 points, thickness 1 [N/mm], (8, 8)."""
    width, height = block.WIDTH / block.COLUMNS, block.HEIGHT / block.ROWS
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    law = np.array([[block.LAMBDA + 2.0 * block.MU, block.LAMBDA, 0.0], [block.LAMBDA, block.LAMBDA + 2.0 * block.MU, 0.0],
                    [0.0, 0.0, block.MU]])
    stiffness = np.zeros((8, 8))
    for point in corners / np.sqrt(3.0):
        by_x = corners[:, 0] * (1.0 + corners[:, 1] * point[1]) / (2.0 * width)
        by_y = corners[:, 1] * (1.0 + corners[:, 0] * point[0]) / (2.0 * height)
        strain = np.zeros((3, 8))
        strain[0, 0::2] = strain[2, 1::2] = by_x
        strain[1, 1::2] = strain[2, 0::2] = by_y
        stiffness += strain.T @ law @ strain * (width * height / 4.0)
    return stiffness


def rates_without_contact():
    """C, w: displacement rates of the lower nodes = C (rates of their forces) + w per unit of gamma; x and y in turn."""
    across = block.COLUMNS + 1
    free = 2 * across * block.ROWS  # the upper nodes, which are held, are the last ones
    matrix, load = np.zeros((free + 2 * across,) * 2), np.zeros(free + 2 * across)
    own = element_stiffness()
    for row in range(block.ROWS):
        for column in range(block.COLUMNS):
            first = row * across + column
            dofs = [2 * node + axis for node in (first, first + 1, first + across + 1, first + across) for axis in (0, 1)]
            matrix[np.ix_(dofs, dofs)] += own
        for side, column in ('left', 0), ('right', block.COLUMNS):
            for node in (row * across + column, (row + 1) * across + column):
                load[2 * node:2 * node + 2] += -2.0 * np.array(block.FIRST[side]) * block.HEIGHT / block.ROWS / 2.0
    lower = np.eye(free)[:, :2 * across]
    solved = np.linalg.solve(matrix[:free, :free], np.column_stack([lower, load[:free]]))
    return solved[:2 * across, :-1], solved[:2 * across, -1]


def combinations(numbers):
    """The states of all contacts by the number of a combination, (numbers, COUNT)."""
    return numbers[:, None] // STATES ** np.arange(COUNT) % STATES


def solutions():
    """The rates of all branches from gamma = 1/2 towards gamma = 1, (branches, COUNT, 4): of x, gap, friction and normal forces."""
    flexibility, free = rates_without_contact()
    found = []
    for begin in range(0, STATES ** COUNT, BATCH):
        states = combinations(np.arange(begin, begin + BATCH))
        # The unknowns are the forces, x and y in turn: what holds along x, and across.
        matrix, right = np.zeros((BATCH, 2 * COUNT, 2 * COUNT)), np.zeros((BATCH, 2 * COUNT))
        for i in range(COUNT):
            x, y = 2 * i, 2 * i + 1
            state = states[:, i]
            is_open, sticks = state == OPEN, state == STICK
            slides = ~is_open & ~sticks
            matrix[is_open, y, y] = 1.0
            matrix[~is_open, y] = flexibility[y]
            right[~is_open, y] = -free[y]
            matrix[sticks, x] = flexibility[x]
            right[sticks, x] = -free[x]
            matrix[~sticks, x, x] = 1.0
            matrix[slides, x, y] = np.where(state[slides] == PLUS, block.FRICTION, -block.FRICTION)
        forces = np.linalg.solve(matrix, right[..., None])[..., 0]
        rates = forces @ flexibility.T + free
        rt, rn, vx, gap = forces[:, 0::2], forces[:, 1::2], rates[:, 0::2], rates[:, 1::2]
        some_force, some_rate = NOTHING * abs(forces).max(axis=1)[:, None], NOTHING * abs(rates).max(axis=1)[:, None]
        obeyed = np.where(states == OPEN, gap >= -some_rate, rn >= -some_force)
        obeyed &= (states != STICK) | (abs(rt) <= block.FRICTION * rn + some_force)
        obeyed &= ((states != PLUS) | (vx >= -some_rate)) & ((states != MINUS) | (vx <= some_rate))
        for k in np.flatnonzero(obeyed.all(axis=1)):
            rate = np.stack([vx[k], gap[k], rt[k], rn[k]], axis=1)
            if not any(np.allclose(rate, other, rtol=0.0, atol=1e-6 * abs(rate).max()) for other in found):
                found.append(rate)
    return np.array(found)


def states(rates):
    """The names of the states of all contacts at these rates (COUNT, 4)."""
    nothing = NOTHING * abs(rates[:, :2]).max()

    def state(vx, gap):
        if gap > nothing:
            return 'open'
        return 'slip+' if vx > nothing else 'slip-' if vx < -nothing else 'stick'
    return tuple(state(*rate[:2]) for rate in rates)
