#!/usr/bin/env python3
"""Draws the figures of the benchmarks and rewrites the tables of README.md between its markers.

report.py RESULTS BENCH [PART...]: RESULTS holds what scripts/bench measured, BENCH the README and the folder for the figures;
the parts of the README to write, by the names of their markers; none: all but peers, which is measured apart.
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
            cells.append([scene, row['method'], setting(row), row['increments'] + (' (cut)' if row['end'] == 'cut' else ''),
                          number(float(row['seconds']) / base),
                          number(row['row_error']), number(row['line_error']), number(row['limit_error']),
                          number(row['dissipation_error']),
                          number(row['factorisations'] if row['method'] == 'branch' else row['iterations']),
                          row['rejected']])
    return table(['scene', 'method', 'setting', 'increments', 'time / branch balanced', 'increments off by', 'lines off by',
                  'limit loads off by', 'dissipation off by', 'factorisations or iterations per increment', 'rejected'], cells)


BLAS = (('openblas-serial', 'OpenBLAS'), ('blas', 'reference'))


def scale_entries(results, blas, what):
    """What was measured of one benchmark with one BLAS, by size and then by number of contacts."""
    entries = [entry for path in results.glob('scale_%s_%s_*.json' % (blas, what)) for entry in read_benchmarks(path)]
    return sorted(entries, key=lambda entry: (entry['dofs'], entry['contacts']))


def scaling(results, figures):
    figure, axis = plt.subplots(figsize=(5.5, 4))
    cells, text = [], ''
    for blas, name in BLAS:
        smooth = scale_entries(results, blas, 'SmoothIncrement')
        events = {entry['dofs']: entry for entry in scale_entries(results, blas, 'Event')}
        starts = scale_entries(results, blas, 'EventOfContacts')
        for entry in smooth:
            event = events.get(entry['dofs'])
            of_contacts = [number(start['per_cholmod']) for start in starts if start['dofs'] == entry['dofs']]
            cells.append([name, '%d' % entry['dofs'], '%d' % entry['contacts'], number(entry['real_time']),
                          number(entry['per_cholmod']), number(event['per_cholmod']) if event else '',
                          ' / '.join(of_contacts), number(entry['peak_MiB']), number(event['peak_MiB']) if event else ''])
        first = smooth[0]
        last = next(entry for entry in smooth if entry['dofs'] > 5e4)
        text += '\nExponent of the time per increment from 10^3 to 10^5 dofs, %s: %.2f.\n' % (
            name, math.log(last['real_time'] / first['real_time']) / math.log(last['dofs'] / first['dofs']))
        axis.loglog([entry['dofs'] for entry in smooth], [entry['real_time'] for entry in smooth], 'o-',
                    label='increment, ' + name)
        axis.loglog([entry['dofs'] for entry in smooth], [entry['cholmod_ms'] for entry in smooth], 's--',
                    label='CHOLMOD, ' + name)
    axis.set_xlabel('degrees of freedom')
    axis.set_ylabel('time [ms]')
    axis.legend()
    axis.grid(True, which='major', alpha=0.3)
    figure.tight_layout()
    figure.savefig(figures / 'scaling.png', dpi=110)
    plt.close(figure)
    return table(['BLAS', 'dofs', 'candidates', 'increment [ms]', 'increment / CHOLMOD', 'event / CHOLMOD',
                  'start with 1 / 5 / 20 contacts that touch / CHOLMOD', 'peak memory [MiB]', 'with events [MiB]'],
                 cells) + text


def parts(results):
    cells = []
    for what, name in (('FrameIncrement', 'frame'), ('SolidIncrement', 'solid')):
        for entry in scale_entries(results, 'openblas-serial', what):
            cells.append([name, '%d' % entry['dofs'], number(entry['real_time']), number(entry['factorisations']),
                          number(entry['per_cholmod']), number(entry['peak_MiB'])])
    return table(['structure', 'dofs', 'increment [ms]', 'factorisations', 'increment / CHOLMOD', 'peak memory [MiB]'], cells)


def assembly(results):
    materials, planes = {'0': 'neo_hookean', '3': 'linear'}, ('strain', 'stress')
    rows = []
    for entry in read_benchmarks(results / 'assembly.json'):
        _, material, plane = entry['name'].split('/')[:3]
        rows.append([materials[material], planes[int(plane)], number(entry['real_time']), number(entry['per_cholmod'])])
    return table(['material', 'plane', 'assembly [ms]', 'assembly / CHOLMOD'], rows)


def sliding(results):
    cells = []
    for blas, name in BLAS:
        entries = read_benchmarks(results / ('scale_%s_PointOfAnArc.json' % blas))
        base = entries[0]['real_time']
        cells += [[name, entry['name'].split('/')[1], number(entry['real_time'] / base), number(entry['per_cholmod'])]
                  for entry in entries]
    return table(['BLAS', 'contacts that slide', 'time, of the first', 'time / CHOLMOD'], cells)


def mpec(results):
    cells = []
    for blas, name in BLAS:
        for entry in read_benchmarks(results / ('scale_%s_MpecIncrement.json' % blas)):
            cells.append([name, '%d' % entry['dofs'], '%d' % entry['contacts'],
                          ('out of reach', 'along the floor')[int(entry['name'].split('/')[2])], number(entry['real_time']),
                          number(entry['iterations']), number(entry['per_cholmod'] / entry['iterations'])])
    return table(['BLAS', 'dofs', 'candidates', 'where', 'increment [ms]', 'iterations of Ipopt', 'iteration / CHOLMOD'], cells)


def contact(results):
    rows = [['%d' % entry['dofs'], number(entry['factorisations']), number(entry['per_factorisation'])]
            for entry in read_benchmarks(results / 'contact.json')]
    return table(['dofs', 'factorisations per increment', 'time of an increment / of one factorisation'], rows)


def far(results):
    all_runs = [run for run in read_benchmarks(results / 'far.json') if run['run_type'] == 'iteration']
    cells = []
    for name, against in (('IncrementWithFarCandidates', 'half planes'), ('IncrementWithFarCurve', 'a polyline of 1,000 edges')):
        runs = [run for run in all_runs if run['name'].startswith(name + '/')]
        near, with_far = (min((run for run in runs if run['candidates'] == count), key=lambda run: run['real_time'])
                          for count in sorted({run['candidates'] for run in runs}))
        cells.append(['%d' % near['dofs'], '%d' % near['candidates'], '%d' % (with_far['candidates'] - near['candidates']), against,
                      '%+.1f %%' % (100.0 * (with_far['real_time'] / near['real_time'] - 1.0))])
    return table(['dofs', 'candidates', 'candidates out of reach', 'against', 'time per increment'], cells)


def solvers(results):
    names = {'KluAgain': 'KLU, pattern and pivots kept (used below 3,000 unknowns)', 'KluAnew': 'KLU, pivots chosen anew',
             'UmfpackMetis': 'UMFPACK, METIS, symmetric strategy (used from 3,000 on)', 'UmfpackDefaults': 'UMFPACK, defaults',
             'Spqr': 'SPQR'}
    sizes = (('1000', '10^3'), ('10000', '10^4'), ('100000', '10^5'))
    states = (('0', 'sticking'), ('1', 'sliding'))
    rows = []
    for blas, blas_name in BLAS:
        times = {tuple(entry['name'].split('/')): entry['real_time']
                 for entry in read_benchmarks(results / ('solvers_%s.json' % blas))}
        for key, name in names.items():
            rows.append([blas_name, name] + [
                number(times[(key, size, state)] / times[('CholmodTangent', size, '0')]) if (key, size, state) in times else ''
                for size, _ in sizes for state, _ in states])
    return table(['BLAS', 'solver'] + ['%s dofs, %s' % (size, state) for _, size in sizes for _, state in states], rows)


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


def peers(results, figures):
    with open(results / 'peers.json') as file:
        found = json.load(file)
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2), sharex=True)
    for axis, part, label in ((axes[0], 'rn', 'normal force [N]'), (axes[1], 'rt', 'friction force [N]')):
        for run, style in (('total', '-'), ('incremental', '--')):
            axis.plot(found[run]['gamma'], found[run][part], 'k' + style, linewidth=1, label='contact_path, %s law' % run)
        axis.plot(found['getfem']['gamma'], found['getfem'][part], 'o', color='tab:orange', markersize=3, label='GetFEM')
        axis.set_xlabel('gamma')
        axis.set_ylabel('%s of the third node from the right' % label)
        axis.grid(True, which='major', alpha=0.3)
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(figures / 'peers.png', dpi=110)
    plt.close(figure)
    rows = [[row['what']] + [row[key] if isinstance(row[key], str) else number(row[key]) for key in ('getfem', 'own', 'ratio')]
            for row in found['table']]
    return table(['', 'GetFEM', 'contact_path', 'ratio'], rows) + '\n' + found['text'] + '\n'


TABLES = {part.__name__: part for part in (sliding, parts, assembly, mpec, contact, far, solvers, models, streaming)}
WITH_FIGURES = {part.__name__: part for part in (trade, scaling, peers)}


def main():
    results, bench = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    figures = bench / 'figures'
    figures.mkdir(exist_ok=True)
    names = sys.argv[3:] or [name for name in (*WITH_FIGURES, *TABLES) if name != 'peers']
    tables = {name: WITH_FIGURES[name](results, figures) if name in WITH_FIGURES else TABLES[name](results) for name in names}
    readme = bench / 'README.md'
    text = readme.read_text()
    for name, part in tables.items():
        begin, end = '<!-- %s -->\n' % name, '<!-- end of %s -->' % name
        before, rest = text.split(begin)
        text = before + begin + part + end + rest.split(end)[1]
    readme.write_text(text)


if __name__ == '__main__':
    main()
