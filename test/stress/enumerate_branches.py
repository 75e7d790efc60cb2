"""All arcs that leave a point of a path, found from the scene alone.

Shares nothing with the solvers: it knows neither their rates nor the reactions of the contacts. Used are positions x, the
load factor s and the scene. With phi(x, s) the internal forces less the loads [force, by component of a node], the contacts of
a node give it the force F = phi. Coulomb's law is a statement about that force and the motion of the node: with the contacts
in given states, F lies in the cone of the forces

    open: none       closed: n       stick: n + mu t and n - mu t       slip+: n - mu t       slip-: n + mu t

each times any number >= 0; n is the normal towards the admissible side, t = (n_y, -n_x). So reactions that are not unique, as
between two walls, need no choice: each set of them that gives F is admissible. One set is not: walls that face each other do
not squeeze the node between them, since nothing tells with which force. The motion since the point keeps the gap of closed
contacts, the place of sticking ones, the sense of sliding ones and no negative gap.

For each combination of states, points on spheres around the point, |(dx, ds)| = rho in the free components, that fulfil the
equations are searched by Newton's method, from the null directions of the equations. A branch is a point that fulfils the
inequalities as well. No derivatives along a path are used, so that singular points need no rule of their own.
"""
import functools
import itertools

import numpy as np

from static_problem import NEAR

RADII = (1e-4, 1e-5)        # of the spheres [length, and load factor]
START_RADII = (1e-3, 1e-4)  # at a start, where the load factor may change with the third power of the way
WANTED = 1e-9       # share of the load factor in a unit motion that is a change in the wanted sense
TOUCHES = 1e-8      # gap [length]
AT_LIMIT = 1e-8     # force by which the force of a node may be outside of a cone at the point itself
SOLVED = 1e-12      # largest residual of a solution
INEXACT = 2e-10     # inequalities at the point are known to about this
CURVED = 1e-3       # times rho^2: an inequality may be broken by that much
GROWS = 5e-12       # by which an inequality is broken more on the larger sphere: not inexact, but broken by the curve
WEAK = 0.05         # singular values of the equations below this share of the largest: null directions, or nearly
MOST_WEAK = 6       # directions that are searched together
STARTS = 12         # of Newton's method, where there is more than one null direction
CLEARLY = 0.1       # unit rate of an inequality by which a direction is not looked at
SAME = 1e-2         # times rho: solutions nearer to each other are one
ALIKE = 0.1         # unit motions on two spheres that are of one branch differ by less
MOST_COMBINATIONS = 20000


class Undecided(Exception):
    """There are too many combinations of states."""


def hull_and_faces(edges, components):
    """Of the cone { sum of a number >= 0 . edge } in the free components (indices into x, y) of a node.

    Returns equations (rows e: e . F = 0) and inequalities (rows h: h . F >= 0) that together are the cone.
    """
    size = len(components)
    if not edges:
        return np.eye(size), np.zeros((0, size))
    spanned = np.array(edges)[:, components]
    _, values, right = np.linalg.svd(spanned)
    rank = int(np.sum(values > 1e-9))
    hull = right[:rank]
    inside = spanned @ hull.T
    if rank == 1:
        candidates = np.array([[1.0], [-1.0]])
    elif rank == 2:
        turned = inside[:, ::-1] * (1.0, -1.0)
        turned /= np.maximum(np.hypot(*turned.T), 1e-300)[:, None]
        candidates = np.concatenate([turned, -turned])
    else:
        candidates = []
    faces = [row @ hull for row in candidates if np.all(inside @ row >= -1e-9) and np.any(np.abs(row) > 0.5)]
    return right[rank:], np.array(faces).reshape(-1, size)


class NodeState:
    """The contacts of one node in given states, as equations and inequalities in z and in the node's force."""

    def __init__(self, problem, node, contacts, states):
        self.states = dict(zip(contacts, states))
        self.components = [k for k in (0, 1) if 2 * node + k in problem.free]
        self.dofs = np.array([2 * node + k for k in self.components], dtype=int)
        edges, kept, wanted, self.normals = [], [], [], []
        for i, state in self.states.items():
            contact = problem.contacts[i]
            edges += contact.edges(state)
            (wanted if state == 'open' else kept).append(problem.row_of(contact, contact.normal))
            if state != 'open':
                self.normals.append(contact.normal)
            tangential = problem.row_of(contact, contact.tangent)
            if state == 'stick':
                kept.append(tangential)
            elif state in ('slip+', 'slip-'):
                wanted.append(tangential if state == 'slip+' else -tangential)
        size = len(problem.free) + 1
        self.kept = independent(np.array(kept).reshape(-1, size))
        self.wanted = np.array(wanted).reshape(-1, size)
        self.wanted = self.wanted - self.wanted @ self.kept.T @ self.kept
        self.wanted = self.wanted[np.linalg.norm(self.wanted, axis=1) > 1e-9]
        self.edges = np.array(edges).reshape(-1, 2)[:, self.components]
        self.equations, self.faces = hull_and_faces(edges, self.components)

    def admits(self, force):
        """Whether the force of the node [force, by component] lies in the cone."""
        own = force[self.dofs]
        return np.all(np.abs(self.equations @ own) <= AT_LIMIT) and np.all(self.faces @ own >= -AT_LIMIT)

    def squeezes(self):
        """Whether walls that carry face each other, or more walls carry than can be needed: any force of the node is the force
        of at most two edges of cones."""
        normals = np.array(self.normals).reshape(-1, 2)[:, self.components]
        return len(independent(normals)) < len(normals)

    def includes(self, other):
        """Whether each motion and force of the other is one of this as well, and so it needs no look of its own."""
        same_motion = self.kept.shape == other.kept.shape and np.allclose(self.kept.T @ self.kept, other.kept.T @ other.kept,
                                                                         atol=1e-9)
        looser = all(np.any(np.linalg.norm(other.wanted - row, axis=1) <= 1e-9) for row in self.wanted)
        contains = (np.all(np.abs(other.edges @ self.equations.T) <= 1e-9) and
                    np.all(other.edges @ self.faces.T >= -1e-9))
        # A cone of more dimensions has more solutions, and its curves are looked for by its faces.
        return same_motion and looser and contains and (
            self.equations.shape == other.equations.shape or len(self.kept) >= len(self.components))


def independent(rows):
    """Orthonormal rows that span the same."""
    _, values, right = np.linalg.svd(rows) if len(rows) else (None, np.zeros(0), np.eye(rows.shape[1]))
    return right[:int(np.sum(values > 1e-9))]


def node_states(problem, z):
    """For each node that touches an obstacle, its NodeStates whose cone has the force at z."""
    x, force = problem.positions(z), problem.forces(z)[0]
    touching = {}
    for i, contact in enumerate(problem.contacts):
        if contact.gap(x, z[-1]) <= TOUCHES:
            touching.setdefault(contact.node, []).append(i)
    result = []
    for node, contacts in touching.items():
        free = np.isin([2 * node, 2 * node + 1], problem.free)
        options = [['open'] + problem.contacts[i].states(free) for i in contacts]
        found = []
        for states in itertools.product(*options):
            candidate = NodeState(problem, node, contacts, states)
            if candidate.squeezes():
                continue
            if candidate.admits(force) and not any(other.includes(candidate) for other in found):
                found = [other for other in found if not candidate.includes(other)] + [candidate]
        result.append(found)
    return result


class Combination:
    """The equations and inequalities of one combination of states, in y: z = origin + motions y."""

    def __init__(self, problem, origin, nodes):
        self.problem, self.origin, self.nodes = problem, origin, nodes
        size = origin.size
        kept = np.concatenate([node.kept for node in nodes] + [np.zeros((0, size))])
        _, values, right = np.linalg.svd(np.concatenate([kept, np.zeros((1, size))]))
        self.motions = right[int(np.sum(values > 1e-9)):].T
        held = {dof for node in nodes for dof in node.dofs}
        rows = [np.eye(problem.base.size)[dof] for dof in problem.free if dof not in held]
        faces = []
        for node in nodes:
            for local, target in ((node.equations, rows), (node.faces, faces)):
                for row in local:
                    full = np.zeros(problem.base.size)
                    full[node.dofs] = row
                    target.append(full)
        self.rows = np.array(rows).reshape(-1, problem.base.size)
        self.faces = np.array(faces).reshape(-1, problem.base.size)
        self.wanted = np.concatenate([node.wanted for node in nodes] + [np.zeros((0, size))])
        x = problem.positions(origin)
        self.beside = [contact for contact in problem.contacts
                       if contact.gap(x, origin[-1]) > TOUCHES]  # open, and not to be touched on the way

    def dimension(self):
        """Of the set of solutions, by counting."""
        return self.motions.shape[1] - len(self.rows)

    def states(self):
        merged = {}
        for node in self.nodes:
            merged.update(node.states)
        return {self.problem.contact_names[i]: state for i, state in sorted(merged.items())}

    def residual(self, y):
        force, slopes = self.problem.forces(self.origin + self.motions @ y)
        return self.rows @ force, self.rows @ slopes @ self.motions

    def broken(self, y):
        """By how much the worst inequality is broken, relative to what it is at the origin if it is broken there."""
        z = self.origin + self.motions @ y
        force, at_origin = self.problem.forces(z)[0], self.problem.forces(self.origin)[0]
        x = self.problem.positions(z)
        values = [self.faces @ force - np.minimum(self.faces @ at_origin, 0.0), self.wanted @ (z - self.origin),
                  np.array([contact.gap(x, z[-1]) for contact in self.beside])]
        return max((-value for group in values for value in group), default=0.0)

    def rates_of_inequalities(self):
        """Rows: derivatives by y of the inequalities that hold as equations at the origin."""
        force, slopes = self.problem.forces(self.origin)
        at_limit = self.faces @ force <= AT_LIMIT
        return np.concatenate([self.faces[at_limit] @ slopes, self.wanted]) @ self.motions

    def starts(self, rng):
        """Unit directions to start Newton's method from."""
        rates = self.rates_of_inequalities()
        rates /= np.maximum(np.linalg.norm(rates, axis=1), 1e-12)[:, None]
        jacobian = self.residual(np.zeros(self.motions.shape[1]))[1]
        if jacobian.shape[1] == 0:
            return
        _, values, right = np.linalg.svd(np.concatenate([jacobian, np.zeros((1, jacobian.shape[1]))]))
        weak = max(1, jacobian.shape[1] - int(np.sum(values > WEAK * max(values[0], 1e-300))))
        null = right[-min(weak, MOST_WEAK):].T
        if null.shape[1] == 1:
            for direction in (null[:, 0], -null[:, 0]):
                if np.all(rates @ direction >= -CLEARLY):
                    yield direction
            return
        rates = rates @ null
        rates /= np.maximum(np.linalg.norm(rates, axis=1), 1e-12)[:, None]
        for k in range(STARTS):
            direction = rng.standard_normal(null.shape[1])
            # Every other start is turned towards where the inequalities hold.
            for _ in range(100 if k % 2 else 0):
                direction /= np.linalg.norm(direction)
                worst = int(np.argmin(rates @ direction)) if len(rates) else 0
                if not len(rates) or rates[worst] @ direction >= 1e-3:
                    break
                direction -= 1.5 * (rates[worst] @ direction - 2e-3) * rates[worst]
            yield null @ (direction / np.linalg.norm(direction))

    def on_sphere(self, start, radius):
        """A solution with |y| = radius; None if Newton's method finds none."""
        y = radius * start
        for _ in range(30):
            residual, jacobian = self.residual(y)
            system = np.concatenate([jacobian, 2.0 * y[None, :] / radius])
            step = np.linalg.lstsq(system, -np.append(residual, (y.dot(y) - radius**2) / radius), rcond=1e-12)[0]
            length = np.linalg.norm(step)
            if not np.isfinite(length):
                return None
            y = y + step * min(1.0, radius / max(length, 1e-300))
            if length < 1e-3 * SOLVED:
                break
        residual = self.residual(y)[0]
        if np.max(np.abs(residual), initial=0.0) > SOLVED or abs(np.linalg.norm(y) / radius - 1.0) > 1e-6:
            return None
        return y

    def solutions(self, radius, starts):
        found = []
        for start in starts:
            y = self.on_sphere(start, radius)
            if y is not None and all(np.linalg.norm(y - other) > SAME * radius for other in found):
                found.append(y)
        return found


class Branch:
    """states: contact -> state, of contacts that touch. motion: (dx, ds) of free components, of unit length. radius: of the
    sphere on which it was found. broken: by how much an inequality is, at most. dimension: of the set of solutions, 1 = a
    curve."""

    def __init__(self, combination, y, radius):
        self.states = combination.states()
        self.motion = combination.motions @ y / radius
        self.radius = radius
        self.broken = max(combination.broken(y), 0.0)
        self.dimension = combination.dimension()

    def __str__(self):
        return 'radius %g: ds %+.3e, dimension %d, %s' % (
            self.radius, self.motion[-1], self.dimension,
            ' '.join('%s %s' % state for state in self.states.items()) or 'no contact touches')

    def is_admissible(self):
        return self.broken <= max(INEXACT, CURVED * self.radius**2)

    def goes_on_from(self, farther):
        """Whether this is a point, on the smaller sphere, of the branch that meets the larger sphere there."""
        return np.linalg.norm(self.motion - farther.motion) <= ALIKE and farther.broken - self.broken <= GROWS


def way_back(problem, origin, combinations, rows, radius):
    """The motion (dx, ds) / radius along which the path arrived, on the sphere; None at a start.

    rows: of the CSV, those of the stage up to the point. The direction to the increment before, corrected onto the equations
    by the combination that needs the least correction.
    """
    distances = [np.linalg.norm(problem.z_of(row) - origin) for row in rows]
    farther = [k for k, distance in enumerate(distances) if distance > NEAR]
    if not farther:
        return None
    beyond = [k for k in farther if distances[k] >= radius]
    before = beyond[-1] if beyond else farther[-1]
    chord = problem.z_of(rows[before]) - origin
    chord /= np.linalg.norm(chord)
    nearest, best = chord, -1.0
    for combination in combinations:
        start = combination.motions.T @ chord
        if np.linalg.norm(start) < 0.5:
            continue
        y = combination.on_sphere(start / np.linalg.norm(start), radius)
        if y is None:
            continue
        motion = combination.motions @ y / radius
        if motion.dot(chord) > best:
            nearest, best = motion, motion.dot(chord)
    return nearest


def branches_from(problem, rows, seed=0):
    """The branches from the last of `rows` (of the CSV, of the stage), without the way back; at a start those on which the
    load factor begins to change in the wanted sense."""
    origin = problem.z_of(rows[-1])
    options = node_states(problem, origin)
    if np.prod([float(len(option)) for option in options]) > MOST_COMBINATIONS:
        raise Undecided('%g combinations of states' % np.prod([float(len(option)) for option in options]))
    combinations = [Combination(problem, origin, nodes) for nodes in itertools.product(*options)]
    rng = np.random.default_rng(seed)
    backwards = functools.lru_cache(None)(lambda radius: way_back(problem, origin, combinations, rows, radius))
    is_start = all(np.linalg.norm(problem.z_of(row) - origin) <= NEAR for row in rows)
    result = []
    for combination in combinations:
        starts = list(combination.starts(rng))
        before = []
        for radius in START_RADII if is_start else RADII:
            branches = [Branch(combination, y, radius) for y in combination.solutions(radius, starts)]
            branches = [branch for branch in branches
                        if branch.is_admissible() and goes_on(problem, branch, backwards(radius))]
            result += [branch for branch in branches if any(branch.goes_on_from(other) for other in before)]
            before = branches
    return result


def goes_on(problem, branch, back):
    if back is None:
        return branch.motion[-1] * problem.sense > WANTED
    return np.linalg.norm(branch.motion - back) > 5.0 * SAME
