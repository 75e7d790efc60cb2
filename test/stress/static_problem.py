"""Forces of a scene of bars and half planes, as functions of positions and the load factor, told from the scene alone."""
import numpy as np

NEAR = 1e-9         # increments nearer to each other than this are at one place [length, and load factor]


class Contact:
    """A node against a half plane that moves with `velocity` per unit of the load factor."""

    def __init__(self, node, obstacle, shift, velocity):
        self.node = node
        self.normal = np.array([obstacle.get('nx', 0.0), obstacle.get('ny', 0.0)])
        self.normal /= np.hypot(*self.normal)
        self.tangent = np.array([self.normal[1], -self.normal[0]])
        self.point = np.array([obstacle.get('px', 0.0), obstacle.get('py', 0.0)]) + shift
        self.velocity = velocity
        self.friction = obstacle.get('friction', 0.0)

    def gap(self, positions, load_factor):
        return self.normal.dot(positions[self.node] - self.point - load_factor * self.velocity)

    def states(self, free):
        """States other than open. free: whether the x and the y of the node are free."""
        slides = self.friction > 0.0 and np.any(np.abs(self.tangent[free]) > 1e-12)
        return ['stick', 'slip+', 'slip-'] if slides else ['closed']

    def edges(self, state):
        """The forces that span what the contact can give in a state."""
        ratios = {'open': [], 'closed': [0.0], 'stick': [self.friction, -self.friction], 'slip+': [-self.friction],
                  'slip-': [self.friction]}[state]
        return [self.normal + ratio * self.tangent for ratio in ratios]


class Problem:
    """A scene in one stage of its program: positions and forces as functions of the free components and the load factor.

    z = (free components of the positions, load factor). request: as in a scene file; stage: counted from 1.
    """

    def __init__(self, request, stage=1):
        scene, program = request['scene'], request.get('program') or []
        self.names = [node['name'] for node in scene['nodes']]
        self.index = {name: i for i, name in enumerate(self.names)}
        self.initial = np.array([[node.get('x', 0.0), node.get('y', 0.0)] for node in scene['nodes']])
        fixed = np.array([[node.get('fixed_x', False), node.get('fixed_y', False)] for node in scene['nodes']])
        self.free = np.flatnonzero(~fixed.ravel())
        bars = scene.get('bars') or []
        self.ends = np.array([[self.index[name] for name in bar['nodes']] for bar in bars], dtype=int).reshape(-1, 2)
        self.lengths = np.hypot(*(self.initial[self.ends[:, 1]] - self.initial[self.ends[:, 0]]).T)
        self.rest = np.array([bar.get('rest_length', 0.0) for bar in bars])
        self.rest = np.where(self.rest > 0.0, self.rest, self.lengths)
        self.stiffness = np.array([bar['EA'] for bar in bars])
        self.strains = np.array([bar.get('strain', 'biot') for bar in bars])
        self.base = self.initial.ravel().copy()  # positions at load factor 0, of fixed components
        self.moves = np.zeros(self.base.size)    # of fixed components, per unit of the load factor
        self.load = np.zeros(self.base.size)     # per unit of the load factor
        self.constant = np.zeros(self.base.size)
        for load in scene.get('loads') or []:
            self.add(load, 'fx', 'fy', self.constant if load.get('constant') else self.load)
        shifts = {}
        for done in program[:stage - 1]:
            share = done.get('target') or 1.0
            for load in done.get('loads') or []:
                self.add(load, 'fx', 'fy', self.constant, share)
            for motion in done.get('support_motions') or []:
                self.add(motion, 'dx', 'dy', self.base, share)
            for motion in done.get('obstacle_motions') or []:
                shifts[motion['obstacle']] = shifts.get(motion['obstacle'], 0.0) + share * of_motion(motion)
        now = program[stage - 1] if program else scene
        for load in program[stage - 1].get('loads') or [] if program else []:
            self.add(load, 'fx', 'fy', self.load)
        for motion in now.get('support_motions') or []:
            self.add(motion, 'dx', 'dy', self.moves)
        velocities = {motion['obstacle']: of_motion(motion) for motion in now.get('obstacle_motions') or []}
        self.sense = -1.0 if program and (now.get('target') or 1.0) < 0.0 else 1.0  # wanted, of the load factor
        obstacles = {obstacle['name']: obstacle for obstacle in scene.get('obstacles') or []}
        none = np.zeros(2)
        self.contacts = [Contact(self.index[contact['node']], obstacles[contact['obstacle']],
                                 shifts.get(contact['obstacle'], none), velocities.get(contact['obstacle'], none))
                         for contact in scene.get('contacts') or []]
        self.contact_names = ['%s@%s' % (contact['node'], contact['obstacle']) for contact in scene.get('contacts') or []]

    def tensions(self, lengths):
        """Of the bars with these lengths, and the derivatives by the length."""
        stretch = lengths / self.rest
        green = 0.5 * (stretch**2 - 1.0)
        logarithm = np.log(stretch)
        kinds = [self.strains == 'green_lagrange', self.strains == 'logarithmic']
        tension = np.select(kinds, [green * stretch, logarithm / stretch], stretch - 1.0)
        slope = np.select(kinds, [stretch**2 + green, (1.0 - logarithm) / stretch**2], 1.0)
        return self.stiffness * tension, self.stiffness * slope / self.rest

    def add(self, entry, x, y, vector, share=1.0):
        node = self.index[entry['node']]
        vector[2 * node:2 * node + 2] += share * np.array([entry.get(x, 0.0), entry.get(y, 0.0)])

    def positions(self, z):
        """By node, (n, 2)."""
        x = self.base + z[-1] * self.moves
        x[self.free] = z[:-1]
        return x.reshape(-1, 2)

    def forces(self, z):
        """phi, by component of a node, and its derivatives by z."""
        x = self.positions(z)
        vectors = x[self.ends[:, 1]] - x[self.ends[:, 0]]
        lengths = np.hypot(*vectors.T)
        tensions, slopes = self.tensions(lengths)
        directions = vectors / lengths[:, None]
        pulls = tensions[:, None] * directions
        force = -(z[-1] * self.load + self.constant).reshape(-1, 2)
        np.add.at(force, self.ends[:, 0], -pulls)
        np.add.at(force, self.ends[:, 1], pulls)
        bends = tensions / lengths
        blocks = directions[:, :, None] * directions[:, None, :] * (slopes - bends)[:, None, None]
        blocks[:, (0, 1), (0, 1)] += bends[:, None]
        stiffness = np.zeros((len(x), len(x), 2, 2))
        for i, j, sign in ((0, 0, 1.0), (1, 1, 1.0), (0, 1, -1.0), (1, 0, -1.0)):
            np.add.at(stiffness, (self.ends[:, i], self.ends[:, j]), sign * blocks)
        stiffness = stiffness.swapaxes(1, 2).reshape(force.size, force.size)
        force = force.ravel()
        return force, np.column_stack([stiffness[:, self.free], stiffness @ self.moves - self.load])

    def row_of(self, contact, vector):
        """The derivative of vector . (place of the contact's node relative to its obstacle) by z."""
        full = np.zeros(self.base.size)
        full[2 * contact.node:2 * contact.node + 2] = vector
        return np.append(full[self.free], full.dot(self.moves) - vector.dot(contact.velocity))

    def z_of(self, increment):
        """increment: a row of the CSV."""
        x = np.array([[float(increment['x_' + name]), float(increment['y_' + name])] for name in self.names])
        return np.append(x.ravel()[self.free], float(increment['load_factor']))

    def rounding(self, z):
        """How far rounding of the coordinates may move a solution of the equations near z; 0 where a contact touches.

        Rounding changes the forces by eps times the largest stiffness; the least singular value is the stiffness against it.
        """
        x = self.positions(z)
        if any(contact.gap(x, z[-1]) < NEAR for contact in self.contacts):
            return 0.0
        values = np.linalg.svd(self.forces(z)[1][self.free], compute_uv=False)
        return np.finfo(float).eps * values[0] / values[-1]

    def shortest_bar(self, z):
        """Smallest length of a bar relative to its initial one."""
        x = self.positions(z)
        return np.min(np.hypot(*(x[self.ends[:, 1]] - x[self.ends[:, 0]]).T) / self.lengths, initial=1.0)


def of_motion(motion):
    return np.array([motion.get('dx', 0.0), motion.get('dy', 0.0)])
