#!/usr/bin/python3
"""The node under load, faults and hostile requests: experiments, one after the other, each with what was measured.

Usage: service_stress.py [--only NAME] [--short] [--table FILE]. Starts a roscore and nodes of its own on the loopback
interface; everything it makes is in one temporary directory. Exit status 0 only if all came out as they should.
"""
import argparse
import os
import sys
import time
import traceback

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))


def enter_environment():
    """Runs this program anew in the environment of the build, where it is not there yet."""
    try:
        import contact_path.srv  # noqa: F401  pylint: disable=unused-import,import-outside-toplevel
    except ImportError:
        environment = os.path.join(os.environ.get('CONTACT_PATH_BUILD', os.path.join(ROOT, 'build')), 'devel', 'env.sh')
        if not os.path.exists(environment) or os.environ.get('CONTACT_PATH_STRESS'):
            sys.exit('service_stress: build the project first: scripts/build')
        os.environ['CONTACT_PATH_STRESS'] = '1'
        os.execv(environment, [environment, sys.executable, os.path.abspath(__file__)] + sys.argv[1:])


def experiments():
    """(name, function, part of the short run)."""
    import faults  # pylint: disable=import-outside-toplevel
    import hostile  # pylint: disable=import-outside-toplevel
    import limits  # pylint: disable=import-outside-toplevel
    import load  # pylint: disable=import-outside-toplevel
    return (('repeated', load.repeated, False), ('clients', load.clients, True), ('cancel', load.cancel, True),
            ('kill', faults.kill, True), ('disk', faults.full_disk, True), ('deaf', load.deaf_subscriber, False),
            ('huge', hostile.huge, True), ('names', hostile.names, True), ('limits', limits.limits, False),
            ('processes', hostile.processes, True), ('master', faults.restarted_master, False))


def write_table(file, increments):
    directory = os.path.dirname(os.path.abspath(file))
    os.makedirs(directory, exist_ok=True)
    with open(file, 'w') as table:
        table.write('| experiment | measured | outcome | s |\n| --- | --- | --- | --- |\n')
        for name, figures, outcome, seconds in increments:
            table.write('| %s | %s | %s | %.0f |\n' % (name, figures.replace('|', '\\|'), outcome, seconds))


def run(world, experiment, short):
    """Name, figures, outcome, seconds."""
    name, function, _ = experiment
    start = time.monotonic()
    try:
        figures, outcome = function(world, short), 'ok'
    except AssertionError as error:
        figures, outcome = str(error), 'FAILED'
    except Exception as error:  # pylint: disable=broad-except  # no experiment keeps the next ones from running
        traceback.print_exc()
        figures, outcome = '%s: %s' % (type(error).__name__, error), 'FAILED'
    try:
        world.stop_nodes()
    except Exception as error:  # pylint: disable=broad-except
        figures, outcome = '%s; a node does not end: %s' % (figures, error), 'FAILED'
    figures = ' '.join(figures.split())
    seconds = time.monotonic() - start
    print('%s: %s' % (name, figures + ': ok' if outcome == 'ok' else 'FAILED: ' + figures), flush=True)
    return name, figures, outcome, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--only', metavar='NAME', help='this experiment alone')
    parser.add_argument('--short', action='store_true', help='a smaller set, of fewer runs each')
    parser.add_argument('--table', metavar='FILE', help='leaves the results as a Markdown table')
    arguments = parser.parse_args()
    enter_environment()
    sys.path[:0] = [HERE, os.path.join(ROOT, 'test', 'ros')]
    chosen = [e for e in experiments() if e[0] == arguments.only or
              not arguments.only and (e[2] or not arguments.short)]
    if not chosen:
        parser.error('there is no experiment %s' % arguments.only)

    from world import World  # pylint: disable=import-outside-toplevel
    world = World()
    try:
        increments = [run(world, experiment, arguments.short) for experiment in chosen]
    finally:
        world.close()
    if arguments.table:
        write_table(arguments.table, increments)
    bad = sum(outcome != 'ok' for _, _, outcome, _ in increments)
    print('%d passed, %d failed' % (len(increments) - bad, bad))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
