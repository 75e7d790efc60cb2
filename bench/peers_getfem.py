#!/usr/bin/python3
"""Follows the block of peers_block.py by GetFEM's continuation, from gamma = 0 to 1, and writes what it found.

peers_getfem.py FILE.json: points of the path with the forces on the lower nodes, processor times, singular points.
"""
import json
import sys
import time

import getfem as gf
import numpy as np

import peers_block as block

HELD, LOWER, SIDES = 1, 2, 3  # regions of the boundary
MOST_STEPS = 1000
# As GetFEM's demonstration has them; lengths of steps are in its weighted norm.
OPTIONS = {'h_init': 5e-4, 'h_max': 0.5, 'h_min': 5e-7, 'h_dec': 0.35, 'max_iter': 5, 'thr_iter': 4, 'max_res': 5e-10,
           'max_diff': 5e-10, 'min_cos': 1.0 - 1e-5, 'max_res_solve': 1e-10, 'singularities': 2, 'nb_dir': 20, 'nb_span': 15}


def make_mesh():
    mesh = gf.Mesh('cartesian', np.linspace(0.0, block.WIDTH, block.COLUMNS + 1), np.linspace(0.0, block.HEIGHT, block.ROWS + 1))
    faces = mesh.outer_faces()
    x, y = mesh.normal_of_faces(faces)
    for region, chosen in ((HELD, y > 0.5), (LOWER, y < -0.5), (SIDES, abs(x) > 0.5)):
        mesh.set_region(region, faces[:, chosen])
    return mesh


def add_contact(model, displacements):
    """Nodal contact with the floor y = 0. Returns the order of the nodes, from left to right."""
    dofs = displacements.dof_on_region(LOWER)
    places = displacements.basic_dof_nodes(dofs)
    across = dofs[1::2]  # x and y in turn
    count = len(across)
    normal, tangential = gf.Spmat('empty', count, displacements.nbdof()), gf.Spmat('empty', count, displacements.nbdof())
    for i, dof in enumerate(across):
        normal.add(i, int(dof), -1.0)
        tangential.add(i, int(dof) - 1, 1.0)
    for multiplier in ('normal_force', 'friction_force'):
        model.add_variable(multiplier, count)
    model.add_initialized_data('augmentation', [10.0])
    model.add_initialized_data('friction', [block.FRICTION])
    model.add_initialized_data('gaps', places[1, 1::2])
    model.add_initialized_data('weights', np.ones(count))
    model.add_basic_contact_brick('u', 'normal_force', 'friction_force', 'augmentation', normal, tangential, 'friction', 'gaps',
                                  'weights', 1)
    return np.argsort(places[0, 1::2])


def tractions(displacements):
    """Those at gamma = 0 by unknown, x and y in turn: linear between both sides, and only the sides carry them."""
    share = displacements.basic_dof_nodes()[0, ::2] / block.WIDTH
    values = np.empty(displacements.nbdof())
    for axis in (0, 1):
        values[axis::2] = (1.0 - share) * block.FIRST['left'][axis] + share * block.FIRST['right'][axis]
    return values


def make_model():
    """The model, the order of its lower nodes, and what GetFEM would forget if Python did."""
    mesh = make_mesh()
    displacements = gf.MeshFem(mesh, 2)
    displacements.set_fem(gf.Fem('FEM_QK(2,1)'))
    points = gf.MeshIm(mesh, gf.Integ('IM_GAUSS_PARALLELEPIPED(2,3)'))  # 2 x 2
    model = gf.Model('real')
    model.add_fem_variable('u', displacements)
    model.add_initialized_data('material', [block.LAMBDA, block.MU, block.A])
    model.add_nonlinear_elasticity_brick(points, 'u', 'Ciarlet Geymonat', 'material')
    model.add_Dirichlet_condition_with_multipliers(points, 'u', displacements, HELD)
    first = tractions(displacements)
    model.add_data('gamma', 1)
    for data, values in (('first', first), ('last', -first), ('now', first)):
        model.add_initialized_fem_data(data, displacements, values)
    model.add_source_term_brick(points, 'u', 'now', SIDES)
    return model, add_contact(model, displacements), (mesh, displacements, points)


def continuation(model):
    options = [item for pair in OPTIONS.items() for item in pair]
    return gf.ContStruct(model, 'gamma', 'first', 'last', 'now', 1.0 / model.nbdof(), *options, 'non-smooth')


def follow(model, order):
    started = time.process_time()
    points, singular = [], []

    def note(gamma):
        points.append({'gamma': gamma, 'time': time.process_time() - started,
                       'rn': list(-model.variable('normal_force')[order]), 'rt': list(model.variable('friction_force')[order])})

    model.solve('max_res', OPTIONS['max_res'], 'max_iter', 200)
    path = continuation(model)
    x, gamma = model.from_variables(), 0.0
    note(gamma)
    tangent, rate, length = path.init_Moore_Penrose_continuation(x, gamma, 1.0)
    while gamma < 1.0 and length > 0.0 and len(points) < MOST_STEPS:
        x, gamma, tangent, rate, length, _, label = path.Moore_Penrose_continuation(x, gamma, tangent, rate, length)
        if length == 0.0:
            break
        gamma = float(gamma)
        if label:
            entry = {'step': len(points), 'label': label, 'time': time.process_time() - started}
            if 'bifurcation' in label:
                _, at, tangents, _ = path.sing_data()
                entry.update(gamma=float(at), branches=int(np.shape(tangents)[-1]))
            singular.append(entry)
        model.to_variables(x)
        note(gamma)
    return {'points': points, 'singular': singular}


def main():
    gf.util_trace_level(0)
    gf.util_warning_level(0)
    with open(sys.argv[1], 'w') as file:
        model, order, _kept = make_model()
        json.dump(follow(model, order), file)


if __name__ == '__main__':
    main()
