// Every tolerance of the solvers, by its meaning: it tells a computed quantity from zero, or from another quantity.
// Constants that steer steps and iterations stand where they are used. verify/, check/ and the rules of scene/ have
// tolerances of their own: verify/ and check/ share the expanded scene and its units with the solvers, and no
// mechanics; rules judge what a person wrote.
//
// Scaled: positions over L, forces over F, the load factor times c (scene/scaling.h). A scene then has numbers of the
// order of 1. Points of a path are exact to about 1e-14, singular points too, since they are located by regular
// equations (branch/crossing.h). Where a sign decides, the error of the value is computed (SmoothArc::ErrorOfRate,
// LinearisedEquations::ErrorOf); the tolerances are for what has no error of its own, and for what coincides: numbers
// of a scene have errors, too.
//
// Tolerances of reactions and of their rates are multiplied with the force unit of the contact
// (contact/contact_pair.h).
#ifndef CONTACT_PATH_TOLERANCES_H_
#define CONTACT_PATH_TOLERANCES_H_

namespace contact_path::tolerances {

// ----- rounding: what cannot be told from zero -----

// Number that few operations make, relative: its last digits.
inline constexpr double kLastDigits = 1e-15;
// Scaled quantity of a converged point, and length of the last Newton step relative to 1 + |x|.
inline constexpr double kRounding = 1e-14;
// Component of a solution of linear equations, as of a unit vector (du, ds), or a reaction of the characteristic force.
// A start along which the load changes less is a mechanism.
inline constexpr double kUnitComponent = 1e-13;
// Scaled length: no motion.
inline constexpr double kNoMove = 1e-12;
// Difference of two values of one quantity that are computed in two ways, relative to the value: equal.
inline constexpr double kEqual = 1e-12;
// Residual of a converged point, scaled; on an arc relative to 1 + the largest of load factor and reactions. An
// inequality that is less below zero holds.
inline constexpr double kResidual = 1e-11;
// Length of a Newton step that no longer shrinks, relative to 1 + |x|, and residual then: rounding.
inline constexpr double kStagnation = 1e-10;
// What rounding may be at a point, of an estimate of it, or of its value at another point. The nodes of a surface have
// shares in a gap that closes: each moves by less than this times the gap.
inline constexpr double kMargin = 16.0;
// Force, of the stiffness of the elements at an unknown, scaled: residuals are measured in it where it is larger
// than 1. Coordinates are known to 1e-15 of their size, which is kResidual of this force.
inline constexpr double kStiffForce = 1e-4;
// Difference of two points of a path, scaled or of the length of the step: it is one point that was found twice.
inline constexpr double kSamePoint = 1e-9;

// ----- active set: which inequalities are at zero -----

// Scaled gap, and scaled reaction or margin to the friction cone, up to which an inequality is weakly active.
inline constexpr double kActive = 1e-10;
// Where the reactions of a path are far below F, kActive follows them down, to this share of the largest of them: a
// path whose largest reaction is 1e-3 F has kActive.
inline constexpr double kActiveShareOfReactions = 1e3 * kActive;
// Gap or length along a surface as a person writes it, scaled, with nine digits: zero. Method mpec expects an
// inequality to change the state of its contact up to this value.
inline constexpr double kTouching = 1e-9;

// ----- rates: of unit vectors (du, ds) -----

// Rate of the load, of slip or of an inequality, second derivative where a rate is zero, difference of two rates: zero.
inline constexpr double kRate = 1e-9;
// Norm of the difference of two unit tangents, or two angles [rad]: of one branch. Angles are known to the root of
// rounding where they are 0, and a chord that is shorter has any direction.
inline constexpr double kSameDirection = 1e-7;
// The same of tangents that were computed at different points or in different ways, and component of a unit vector: the
// node takes no part, the combination of states breaks no inequality.
inline constexpr double kSameTangent = 1e-6;
// Second derivative psi . F''(z, z) along unit null vectors: below, the root of rounding, it says nothing.
inline constexpr double kNoForm = 1e-7;
// Sine of the angle between two vectors, or value of a quadratic form at a root of another one, relative to its size.
inline constexpr double kNearlyParallel = 1e-5;

// ----- rank: of matrices -----

// Smallest over largest pivot of an LU factorisation: singular.
inline constexpr double kSingularPivot = 1e-12;
// The same, above which equations are surely regular; entry of a tangent over the largest, below which nothing resists.
inline constexpr double kRegularPivot = 1e-10;
// Norm of a column of a QR factorisation, relative to the largest: dependent. Stiffness of the parts at a contact,
// scaled, whose reaction is measured in its own force unit: the equations come near to this.
inline constexpr double kDependentColumn = 1e-11;
// The root of rounding: what it leaves of columns, pivots and positions where the equations are known to be singular,
// and of reactions of parts that are softer than this share of the characteristic stiffness. Scaled motion per force by
// which contacts of rigid bodies give way: as much as rounding of coordinates leaves of reactions then.
inline constexpr double kRootOfRounding = 1e-8;
// Pivot, singular value, sine or discriminant of few unknowns, relative to the largest: zero.
inline constexpr double kDependent = 1e-9;
// Norm of an equation, of the largest entries that its unknowns have in any equation: smaller, it is rounding where the
// equations are singular, and counts as large as this: kDependentColumn then is kUnitComponent / 10 of these entries.
inline constexpr double kFadingEquation = 1e-3;

// ----- acceptance -----

// Largest residual, by check/, of an exact point, and of a regularised one, whose residuals are of the order of the
// root of its eps. Error of Ipopt's optimality conditions, as Ipopt scales them: that of an exact point.
inline constexpr double kAccepted = 1e-9;
inline constexpr double kAcceptedRegularised = 1e-5;
// Share of a whole that does not count beside the whole: of the largest reaction so far, of a unit vector, of a step,
// of the range between kSingularPivot and 1.
inline constexpr double kSmallShare = 1e-2;
// Energy balance of a step, of the energy that it exchanges: what a quintic leaves of the longest steps.
inline constexpr double kEnergyOfStep = 2e-3;

// ----- lengths along a curve -----

// Scaled length, or share of a step, next to its start: rates there tell what the start does not, as where the load, or
// an inequality, changes with the third power of the arc length.
inline constexpr double kNextToStart = 1e-3;
// Scaled length along which derivatives at the start hold: a Newton step, relative to 1 + |x|, from which on the
// factors at hand are good enough to finish with.
inline constexpr double kShort = 1e-5;

}  // namespace contact_path::tolerances

#endif  // CONTACT_PATH_TOLERANCES_H_
