#!/usr/bin/env python3
"""Draws the figures of the benchmarks and rewrites the tables of README.md between its markers.

report.py RESULTS BENCH: RESULTS holds what scripts/bench measured, BENCH the README and the folder for the figures.
"""
import csv
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402


def read_csv(path):
    with open(path, newline='') as file:
        return list(csv.DictReader(file))


def read_benchmarks(path):
    with open(path) as file:
        return json.load(file)['benchmarks']


def number(text):
    """Three digits, the way a person writes them."""
    value = float(text)
    if math.isinf(value):
        return 'other count'
    if value == 0:
        return '0'
    return '%.0f' % value if 100 <= value < 1e6 else '%.3g' % value


def table(head, rows):
    lines = ['| ' + ' | '.join(head) + ' |', '| ' + ' | '.join('---' for _ in head) + ' |']
    lines += ['| ' + ' | '.join(str(cell) for cell in row) + ' |' for row in rows]
    return '\n'.join(lines) + '\n'


def setting(row):
    if float(row['step']) > 0:
        return 'step %g' % float(row['step'])
    if row['cold'] == '1':
        return 'cold starts'
    if float(row['eps_min']) > 0:
        return 'eps %g' % float(row['eps_min'])
    return row['accuracy']


def pareto(rows, path):
    """Error of the line through the increments, and of the increments, over time: one scene."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), sharex=True)
    for axis, error, label in ((axes[0], 'line_error', 'lines between increments'), (axes[1], 'row_error', 'increments')):
        for method, colour in (('branch', 'tab:blue'), ('mpec', 'tab:orange')):
            for kind, marker in (('preset', 'o'), ('step', '.'), ('eps', 'x'), ('cold', '+')):
                chosen = [row for row in rows if row['method'] == method and
                          (setting(row).split()[0] if ' ' in setting(row) else 'preset') == kind]
                if not chosen:
                    continue
                axis.loglog([1e3 * float(row['seconds']) for row in chosen],
                            [max(float(row[error]), 1e-17) for row in chosen], linestyle='none', marker=marker,
                            color=colour, label='%s, %s' % (method, {'preset': 'presets', 'step': 'other steps',
                                                                     'eps': 'other eps', 'cold': 'cold starts'}[kind]))
                for row in chosen:
                    if kind == 'preset':
                        axis.annotate(row['accuracy'], (1e3 * float(row['seconds']), max(float(row[error]), 1e-17)),
                                      textcoords='offset points', xytext=(5, 4), fontsize=7, color=colour)
        axis.set_xlabel('time per path [ms]')
        axis.set_ylabel('largest distance of the %s\nfrom the exact path [scaled]' % label)
        axis.grid(True, which='major', alpha=0.3)
    axes[0].legend(fontsize=7)
    figure.suptitle(rows[0]['scene'])
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)


def trade(results, figures):
    rows = read_csv(results / 'trade.csv')
    scenes = list(dict.fromkeys(row['scene'] for row in rows))
    for scene in scenes:
        pareto([row for row in rows if row['scene'] == scene], figures / ('trade_%s.png' % scene))
    cells = []
    for scene in scenes:
        of_scene = [row for row in rows if row['scene'] == scene]
        base = next(float(row['seconds']) for row in of_scene
                    if row['method'] == 'branch' and setting(row) == 'balanced')
        for row in of_scene:
            cells.append([scene, row['method'], setting(row), row['rows'] + (' (cut)' if row['end'] == 'cut' else ''),
                          number(float(row['seconds']) / base),
                          number(row['row_error']), number(row['line_error']), number(row['limit_error']),
                          number(row['dissipation_error']),
                          number(row['factorisations'] if row['method'] == 'branch' else row['iterations']),
                          row['rejected']])
    return table(['scene', 'method', 'setting', 'increments', 'time / branch balanced', 'increments off by', 'lines off by',
                  'limit loads off by', 'dissipation off by', 'factorisations or iterations per increment', 'rejected'], cells)


def scaling(results, figures):
    points = [entry for path in results.glob('increment_*.json') for entry in read_benchmarks(path)]
    points.sort(key=lambda entry: entry['dofs'])
    first, last = points[0], points[-1]
    exponent = math.log(last['real_time'] / first['real_time']) / math.log(last['dofs'] / first['dofs'])
    figure, axis = plt.subplots(figsize=(5.5, 4))
    dofs = [entry['dofs'] for entry in points]
    axis.loglog(dofs, [entry['real_time'] for entry in points], 'o-', label='increment')
    axis.loglog(dofs, [entry['real_time'] / entry['per_factorisation'] for entry in points], 's--',
                label='one factorisation')
    axis.set_xlabel('degrees of freedom')
    axis.set_ylabel('time [ms]')
    axis.legend()
    axis.grid(True, which='major', alpha=0.3)
    figure.tight_layout()
    figure.savefig(figures / 'scaling.png', dpi=110)
    plt.close(figure)
    rows = [['%d' % entry['dofs'], '%d' % entry['candidates'], number(entry['real_time'] / first['real_time']),
             number(entry['factorisations']), number(entry['per_factorisation']), number(entry['peak_MiB'])]
            for entry in points]
    text = table(['dofs', 'candidates', 'time per increment, of the first', 'factorisations per increment',
                  'time of an increment / of one factorisation', 'peak memory [MiB]'], rows)
    return text + '\nExponent of the time per increment from the first line to the last: %.2f.\n' % exponent


def contact(results):
    rows = [['%d' % entry['dofs'], number(entry['factorisations']), number(entry['per_factorisation'])]
            for entry in read_benchmarks(results / 'contact.json')]
    return table(['dofs', 'factorisations per increment', 'time of an increment / of one factorisation'], rows)


def far(results):
    runs = [run for run in read_benchmarks(results / 'far.json') if run['run_type'] == 'iteration']
    near, with_far = (min((run for run in runs if run['candidates'] == count), key=lambda run: run['real_time'])
                      for count in sorted({run['candidates'] for run in runs}))
    change = 100.0 * (with_far['real_time'] / near['real_time'] - 1.0)
    return ('Time per increment of a wall of %d dofs with %d candidates out of reach beside its own %d: %+.1f %% (the shortest of four runs\n'
            'each, in turn).\n' %
            (near['dofs'], with_far['candidates'] - near['candidates'], near['candidates'], change))


def solvers(results):
    entries = read_benchmarks(results / 'solvers.json')
    names = {'KluAgain': 'KLU, pattern and pivots kept (used)', 'KluAnew': 'KLU, pivots chosen anew',
             'KluBlocks': 'the same, block triangular form first', 'KluColamd': 'KLU with COLAMD, pivots anew',
             'CholmodTangent': 'CHOLMOD, tangent stiffness alone', 'Umfpack': 'UMFPACK', 'Spqr': 'SPQR'}
    times = {tuple(entry['name'].split('/')): entry['real_time'] for entry in entries}
    rows = []
    for key, name in names.items():
        row = [name]
        for dofs in ('1000', '10000', '100000'):
            for state in ('0', '1'):
                base = times[('KluAgain', dofs, state)]
                row.append(number(times[(key, dofs, state)] / base) if (key, dofs, state) in times else '')
        rows.append(row)
    flops = [next(entry['flops'] for entry in entries if entry['name'] == 'KluAnew/%s/1' % dofs)
             for dofs in ('1000', '10000', '100000')]
    text = table(['solver'] + ['%s dofs, %s' % (dofs, state) for dofs in ('10^3', '10^4', '10^5')
                               for state in ('sticking', 'sliding')], rows)
    return text + ('\nOperations of the factorisation (KLU, sliding): %.2g, %.2g, %.2g; exponents %.2f and %.2f.\n' %
                   (*flops, math.log10(flops[1] / flops[0]), math.log10(flops[2] / flops[1])))


def models(results):
    rows = read_csv(results / 'model.csv')
    base = {row['method']: float(row['seconds']) for row in rows if row['case'] == 'no contact in reach'}
    return table(['scene', 'method', 'variables', 'constraints', 'time per increment, of the first'],
                 [[row['case'], row['method'], row['variables'], row['constraints'],
                   number(float(row['seconds']) / base[row['method']])] for row in rows])


def streaming(results):
    rows = [[row['full_state_every'], number(row['ratio']), number(row['lower_quartile']) + ' to ' + number(row['upper_quartile']),
             '%.2g' % (float(row['bag_bytes']) / 2**20)]
            for row in read_csv(results / 'streaming.csv')]
    return table(['full_state_every', 'service with bag and subscriber / trace alone', 'quartiles', 'bag [MiB]'], rows)


def main():
    results, bench = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    figures = bench / 'figures'
    figures.mkdir(exist_ok=True)
    parts = {'trade': trade(results, figures), 'scaling': scaling(results, figures), 'contact': contact(results),
             'far': far(results), 'solvers': solvers(results), 'models': models(results), 'streaming': streaming(results)}
    readme = bench / 'README.md'
    text = readme.read_text()
    for name, part in parts.items():
        begin, end = '<!-- %s -->\n' % name, '<!-- end of %s -->' % name
        before, rest = text.split(begin)
        text = before + begin + part + end + rest.split(end)[1]
    readme.write_text(text)


if __name__ == '__main__':
    main()
