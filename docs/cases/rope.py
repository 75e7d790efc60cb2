"""A rope over a drum: the ratio of its tensions when it slides, and what stays when the pull is eased.

Prints two tables; --plot FILE draws the ratio over friction, and while the pull is eased.
"""
import argparse
from math import cos, exp, pi, sin, tan

import contact_path as cp

FRICTIONS = [0.1, 0.3, 0.5, 0.8]
KINKS = [4, 8, 32]
WRAP = pi  # angle of contact [rad]
SOFT, STIFF = 20.0, 1000.0  # EA of the held bar and of all others [force]
SLIDING_PULL = 1.0e-6  # small: it changes the kinks by as much as it is [rad]
EASED_PULL = 1.0e-4


def rope(kinks, friction):
    """A chain with equal kinks on the upper half of a drum of radius 1, both ends hanging down on bars of length 1."""
    scene = cp.Scene('rope')
    scene.obstacle('drum', shape='circle', radius=1.0, friction=friction)
    angles = [pi - (k + 0.5) * WRAP / kinks for k in range(kinks)]
    names = ['n%d' % (k + 1) for k in range(kinks)]
    for name, angle in zip(names, angles):
        scene.node(name, x=cos(angle), y=sin(angle))
        scene.contact(node=name, obstacle='drum')
    for end, angle in ('held', angles[0]), ('pulled', angles[-1]):
        scene.node(end, x=cos(angle), y=sin(angle) - 1.0, fixed_x=True, fixed_y=True)
    chain = ['held', *names, 'pulled']
    for a, b in zip(chain, chain[1:]):
        scene.bar(nodes=[a, b], EA=SOFT if a == 'held' else STIFF)
    return scene


def tensions(path, kinks):
    """Of the held and the pulled bar [force], arrays (increments,): the first and the last one of the chain."""
    return path.quantity('bar1.N'), path.quantity('bar%d.N' % (kinks + 1))


def sliding_ratio(kinks, friction):
    """Of the tensions where all nodes slide."""
    scene = rope(kinks, friction)
    scene.stage('pull', target=SLIDING_PULL).support_motion('pulled', dy=-1.0)
    held, pulled = tensions(cp.trace(scene, record=['sections']), kinks)
    return pulled[-1] / held[-1]


def kinked_ratio(kinks, friction):
    """Closed form for equal kinks, which tends to exp(friction WRAP)."""
    turn = friction * tan(WRAP / (2.0 * kinks))
    return ((1.0 + turn) / (1.0 - turn)) ** kinks


def eased(kinks, friction):
    """The path of a rope that is pulled, then let go by a fifth of that."""
    scene = rope(kinks, friction)
    scene.stage('pull', target=EASED_PULL).support_motion('pulled', dy=-1.0)
    scene.stage('let go', target=0.2 * EASED_PULL).support_motion('pulled', dy=1.0)
    return cp.trace(scene, record=['sections'])


def print_sliding():
    ratios = {}
    print('friction  kinks      path  equal kinks  exp(mu pi)')
    for friction in FRICTIONS:
        for kinks in KINKS:
            ratios[friction, kinks] = sliding_ratio(kinks, friction)
            print('%8.1f  %5d  %8.5f  %11.5f  %10.5f' % (
                friction, kinks, ratios[friction, kinks], kinked_ratio(kinks, friction), exp(friction * WRAP)))
    return ratios


def print_eased(path, kinks, friction):
    """A line for each node that begins to slip back: before it slips, the nodes from there to the held end stick."""
    held, pulled = tensions(path, kinks)
    one = kinked_ratio(kinks, friction) ** (1.0 / kinks)
    print('slips back    let go  pulled/held  closed form  held tension')
    for number, event in enumerate(path.events, 1):
        i = event['index']
        states = event['branches'][event['taken'] - 1]['states']
        node = [contact.split('@')[0] for contact, state in states.items() if state == 'slip-'][0]
        print('%10s  %8.2e  %11.5f  %11.5f  %12.8f' % (
            node, event['load_factor'], pulled[i] / held[i], one ** (kinks - 2 * number), held[i]))


def plot(ratios, path, kinks, friction, file):
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10.0, 4.0), constrained_layout=True)
    smooth = [0.01 * i for i in range(10, 81)]
    for count in KINKS:
        line, = left.semilogy(FRICTIONS, [ratios[mu, count] for mu in FRICTIONS], 'o')
        left.semilogy(smooth, [kinked_ratio(count, mu) for mu in smooth], color=line.get_color(),
                      label='%d kinks' % count)
    left.semilogy(smooth, [exp(mu * WRAP) for mu in smooth], 'k--', label='exp(mu pi)')
    left.set(xlabel='friction', ylabel='tension ratio: points path, lines closed form')
    held, pulled = tensions(path, kinks)
    part = path['stage'] == 2
    right.semilogy(path['load_factor'][part], pulled[part] / held[part], 'o-')
    for number in range(kinks + 1):
        right.axhline(kinked_ratio(kinks, friction) ** (1.0 - 2.0 * number / kinks), color='k', linestyle=':', linewidth=0.8)
    right.set(xlabel='let go', ylabel='tension ratio, %d kinks' % kinks)
    left.legend()
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--plot', metavar='FILE', help='draws the figure')
    options = parser.parse_args()
    ratios = print_sliding()
    path = eased(kinks=8, friction=0.3)
    print_eased(path, kinks=8, friction=0.3)
    if options.plot:
        plot(ratios, path, 8, 0.3, options.plot)


if __name__ == '__main__':
    main()
