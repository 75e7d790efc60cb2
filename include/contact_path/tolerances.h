// Every tolerance of the solvers, by its meaning: it tells a computed quantity from zero, or from another quantity.
// Constants that steer steps and iterations stand where they are used. verify/, check/ and the rules of scene/ have
// tolerances of their own: verify/ and check/ share nothing with the solvers, and rules judge what a person wrote.
//
// Scaled: positions over L, forces over F, the load factor times c (scene/scaling.h). A scene then has numbers of the
// order of 1. Points of a path are exact to about 1e-14 where the equations are regular, and to about 1e-10 next to
// singular points, where half of the digits are lost. That is why many tolerances stand in pairs.
//
// Tolerances of reactions and of their rates are multiplied with the force unit of the contact
// (contact/contact_pair.h).
#ifndef CONTACT_PATH_TOLERANCES_H_
#define CONTACT_PATH_TOLERANCES_H_

namespace contact_path::tolerances {

// ----- rounding: what cannot be told from zero -----

// Length of a Newton step, relative to 1 + |x|: the iteration has converged.
inline constexpr double kNewtonStep = 1e-14;
// Length of a Newton step that no longer shrinks, relative to 1 + |x|: rounding. With the factors of another point
// convergence is linear and may be slow, so the step must be shorter; towards the nearest point the equations may be
// singular, so it may be longer.
inline constexpr double kStagnation = 1e-10;
inline constexpr double kStagnationReused = 1e-13;
inline constexpr double kStagnationSingular = 1e-9;
// Residual of a converged point, scaled; on an arc relative to 1 + the largest of load factor and reactions.
inline constexpr double kResidual = 1e-11;
inline constexpr double kResidualSingular = 1e-10;
// Force, of the stiffness of the elements at an unknown, scaled: residuals are measured in it where it is larger
// than 1. Coordinates are known to 1e-16 of their size, which is kResidual of this force.
inline constexpr double kStiffForce = 1e-4;
// Error of the predictor, scaled, and relative to |x|: a predictor this good needs no shorter step.
inline constexpr double kPredictor = 1e-12;
inline constexpr double kPredictorRounding = 1e-15;
// Component of a unit vector (du, ds): zero. A start along which the load changes less is a mechanism.
inline constexpr double kUnitComponent = 1e-13;
// Component of a unit tangent of an obstacle: zero, as cos(pi / 2) = 6e-17.
inline constexpr double kTangentComponent = 1e-12;
// Reaction, of the characteristic force: zero.
inline constexpr double kReactionRounding = 1e-13;
// Scaled force of an unstressed start, scaled distance from a stop criterion, and load factor that is told as 0, of its
// scale.
inline constexpr double kUnstressed = 1e-14;
inline constexpr double kStopMargin = 1e-14;
inline constexpr double kToldAsZero = 1e-14;
// Load factor, relative to the target that it was located at.
inline constexpr double kAtTarget = 1e-12;
// Error of a force, of what rounding of the positions changes forces by: no rest stress, and no other value of one that
// a path is to have.
inline constexpr double kForceErrors = 16.0;
// Load factor of a record, relative to 1 + |s|, scaled: the point found again is the recorded one. Records of other
// programs may have fewer digits, so this is wider than kAtTarget.
inline constexpr double kRecordedLoad = 1e-9;
// Arc length, relative to the increment: the point found again is the recorded one.
inline constexpr double kRecordedArc = 1e-12;

// Gap, over the extent of the scene, where a gap is to give the scene its length: rounding of a contact that touches.
inline constexpr double kNoGap = 1e-9;
// Newton step of ln C33 of a solid in plane stress, relative to 1 + |ln C33|: converged. Residual of its equation, of
// mu + |lambda|: larger, there is no root.
inline constexpr double kThicknessStep = 1e-15;
inline constexpr double kThicknessResidual = 1e-12;
// Value of eps of method mpec, relative to the smallest one: equal, as eps is found by powers of a factor.
inline constexpr double kRegularisation = 1e-9;
// Coordinate that a stop criterion compares with another one, relative: the last digits.
inline constexpr double kLastDigits = 1e-15;
// Distance from the origin, over the extent of the scene and L: from here on coordinates are counted from the scene.
// Nearer, their rounding is below 1e-12 L.
inline constexpr double kFarFromOrigin = 1e3;

// ----- curves -----

// Newton step of a foot, or of a point at an arc length, in the parameter of the patch: converged.
inline constexpr double kFootStep = 1e-16;
// Newton step of a foot that no longer shrinks, in the parameter tau of the patch, of a parabola relative to 1 + |tau|:
// rounding.
inline constexpr double kFootStagnation = 1e-12;
// Difference of two quadratures of the arc length of a cubic, of the length of the cubic: rounding.
inline constexpr double kArcLength = 4e-16;
// Rounding of a point at the end of a patch, relative to its coordinates and the length of the patch.
inline constexpr double kRoundingOfPoint = 1e-15;
// Difference of the distances of a node from two patches, relative: equally far.
inline constexpr double kEquallyFar = 1e-10;
// Turn of a corner of a polyline [rad]: the edges are in line, and there is no fillet; pi less this: straight back.
inline constexpr double kInLine = 1e-14;
// Rest of an edge between its fillets, of the edge: none.
inline constexpr double kUsedUpEdge = 1e-14;
// Patch, of the length of the curve: too short to be drawn.
inline constexpr double kDrawnPatch = 1e-12;
// Length along a surface to the begin of a patch, relative: equal to pi times the radius.
inline constexpr double kSameLength = 1e-9;
// Distance of a node from a surface, and distance that it has moved, relative: the margin within which it is in reach.
inline constexpr double kReachMargin = 1e-9;

// ----- active set: which inequalities are at zero -----

// Scaled gap, and scaled reaction or margin to the friction cone, up to which an inequality is weakly active.
inline constexpr double kActiveGap = 1e-10;
inline constexpr double kActiveForce = 1e-10;
// Friction coefficient up to which tolerances of normal reactions are divided by it: where a rough contact slips, its
// normal reaction is as exact as its friction force over the coefficient. Beyond, rounding would be told from zero.
inline constexpr double kRoughest = 1e3;
// Scaled gap up to which kActiveGap is widened where it lies among gaps of one size.
inline constexpr double kWidestActiveGap = 5e-10;
// Where the reactions of a path are far below F: kActiveForce follows them down, to this share of the largest of them
// ...
inline constexpr double kActiveShareOfReactions = 1e-7;
// ... and no further than the rounding that the loads leave, relative to max(1, |s|).
inline constexpr double kActiveRoundingOfLoads = 1e-14;
// Scaled gap: the candidate touches at the start. Wider than kActiveGap, since coordinates of scenes are rounded.
inline constexpr double kTouchingAtStart = 1e-9;
// Scaled length by which an open contact is beyond the end of a patch where the next patch takes over: the gap is then
// wrong by the square of it.
inline constexpr double kBeyondPatch = 1e-9;
// Scaled length by which another part of a deformable surface is nearer to a node than the part that it touches.
inline constexpr double kOverrun = 1e-8;
// Scaled value of an inequality between the ends of a step: less below zero is rounding of the interpolation.
inline constexpr double kBrokenOnStep = 1e-11;
// Scaled value of an inequality at an exact point of method mpec: less below zero is rounding.
inline constexpr double kBrokenAtPoint = 1e-11;
// Slip of an increment of method mpec, of its length: the contact has not moved if there is a solution without slip,
// too.
inline constexpr double kRestsAtPoint = 1e-8;
// Scaled slip of an increment of method mpec: rounding.
inline constexpr double kNoSlip = 1e-14;
// Scaled value up to which method mpec expects an inequality to change a contact's state. Wider than kActiveForce: a
// false alarm costs a shorter increment only.
inline constexpr double kNearlyActive = 1e-9;
// Scaled depth to which an inequality may be broken next to a point that it grazes.
inline constexpr double kGraze = 1e-12;

// ----- rates: of unit vectors (du, ds) unless said -----

// One-sided rate of an inequality, and second derivative where its rate is zero: not negative.
inline constexpr double kRate = 1e-9;
inline constexpr double kCurvature = 1e-9;
// Rate of the load, or of slip: the load neither rises nor falls, the contact rests.
inline constexpr double kLevel = 1e-9;
// Rate of slip over the rate of the load, in kLevel over this number: below, slip on a sharp curve cannot be told from
// rest. It is apart from kLevel by this factor.
inline constexpr double kOfHiddenSlip = 0.2;
// Change of the load factor over arc length, from one increment to the next: its sign tells the direction of the path.
inline constexpr double kMovingLoad = 1e-2;
// Difference of two rates: the branches are equally good.
inline constexpr double kSameRate = 1e-9;
// Difference of two angles [rad]: the branches turn alike. An angle is known to the root of rounding where it is 0.
inline constexpr double kSameTurn = 1e-7;
// Rate by which a combination of states breaks an inequality: the combination is excluded.
inline constexpr double kExcludedRate = 1e-6;
// Norm of the difference of two unit tangents: they are of one branch; the tangent is the reversed tangent of arrival.
inline constexpr double kSameDirection = 1e-7;
inline constexpr double kReversed = 1e-6;
// Norm of the difference of two unit tangents that were computed at different points, or in different ways: equal.
inline constexpr double kSameTangent = 1e-6;
// Norm of the difference of a tangent and its interpolation on the step: more is the mark of singular equations.
inline constexpr double kSameDerivative = 1e-2;
// Second derivative psi . F''(z, z) along unit null vectors: below, it says nothing.
inline constexpr double kNoForm = 1e-7;
// Discriminant of a quadratic form, relative to the square of its size: a double root.
inline constexpr double kDoubleRoot = 1e-9;
// Value of a quadratic form at a root of another one, relative to its size: larger, the root is none of this form.
inline constexpr double kOtherForm = 1e-5;
// Difference of two components of a vector, relative: equally large.
inline constexpr double kSameComponent = 1e-6;

// ----- rank: of matrices -----

// Smallest over largest pivot of an LU factorisation: singular.
inline constexpr double kSingularPivot = 1e-12;
// Smallest over largest pivot, above which equations are surely regular: at an event, and on the way to the nearest
// point, where the matrix belongs to a point off the path.
inline constexpr double kRegularPivot = 1e-10;
inline constexpr double kRegularPivotNearest = 1e-8;
// Reaction over the radius of a sharp curve, in the inverse of kSingularPivot: above, it hides the stiffness of the
// parts.
inline constexpr double kOfSingular = 0.01;
// Reciprocal growth of the pivots, with the pivots of an earlier matrix: below, they are chosen anew.
inline constexpr double kPivotGrowth = 1e-4;
// Cosine between the border of a large matrix and the null vector of its Jacobian: below, the border is a bad one.
inline constexpr double kGoodBorder = 1e-5;
// Norm of an equation, of the largest entries that its unknowns have in any equation: smaller, it is rounding where the
// equations are singular, and counts as large as this.
inline constexpr double kFadingEquation = 1e-3;
// Norm of a column of a QR factorisation, relative to the largest: dependent. Where the equations are known to be
// singular, as while a part rests at its limit point or where another path crosses, rounding of an equation that fades
// there counts by kFadingEquation.
inline constexpr double kDependentColumn = 1e-11;
inline constexpr double kDependentColumnSingular = 1e-8;
// Singular value below which unit motions change neither load nor reactions: a rigid mode.
inline constexpr double kRigid = 1e-9;
// Entry of the tangent, relative to the largest: no resistance to a motion.
inline constexpr double kNoResistance = 1e-10;
// Component of a unit null vector: the node takes part in the motion.
inline constexpr double kTakesPart = 1e-6;
// Pivot of the condensed rate problem, relative to the largest: below, rates are not unique.
inline constexpr double kCondensedPivot = 1e-9;
// Motion of a unit solution of the condensed rate problem: up to the first it rests, from the second on it moves, and
// between both the condensed problem does not decide. The first is the root of rounding: motions are known by their
// squares.
inline constexpr double kRestsBelow = 1e-7;
inline constexpr double kMovesAbove = 1e-6;
// Length of a chord between two points of a path: a shorter one may have any direction.
inline constexpr double kHasDirection = 1e-7;
// Sine of the angle between two edges of friction cones: parallel.
inline constexpr double kParallelEdges = 1e-9;

// ----- acceptance -----

// Largest residual, by check/, of an exact point and of a regularised one, whose residuals are of the order of the root
// of its eps.
inline constexpr double kAcceptedExact = 1e-9;
inline constexpr double kAcceptedRegularised = 1e-5;
// Difference of a regularised point from its contact states, of the largest force and of the increment.
inline constexpr double kRegularisedState = 0.1;
// Error of Ipopt's optimality conditions, as Ipopt scales them.
inline constexpr double kInteriorPoint = 1e-9;
// Scaled stiffness of the parts at a contact: below, reactions are lost in rounding. The second where reactions are
// measured in the force unit of the contact: softer equations come near to what counts as singular (kSingularPivot).
inline constexpr double kSoftestContact = 1e-8;
inline constexpr double kSoftestMeasuredContact = 1e-11;
// Reaction that pulls, of the largest reaction so far.
inline constexpr double kPullOfLargest = 1e-2;
// EA L^2 / EI of a beam: above, rounding of the axial force hides the bending.
inline constexpr double kMostSlender = 1e8;
// Length of a bar, or area at an integration point of a solid, over its initial size: collapsed.
inline constexpr double kCollapsed = 1e-2;
// Load factor, of the largest so far: unloaded.
inline constexpr double kUnloaded = 1e-9;
// Difference from an earlier point: of positions and load factor, over the extent of the path, and of reactions, over
// the largest reaction so far. Below, the path has come back to this point.
inline constexpr double kReturnPoint = 1e-9;
inline constexpr double kReturnReaction = 1e-9;

// ----- steps: relative to the length of the step unless said -----

// Scaled distance of an event from the last one, below which it happens in place.
inline constexpr double kNoMove = 1e-12;
// Energy balance of a step, of the energy that it exchanges; rounding of energies, relative.
inline constexpr double kEnergyOfStep = 2e-3;
inline constexpr double kEnergyRounding = 1e-12;
// Place of the smallest value of an inequality on a step: nearer to an end, it is at the end.
inline constexpr double kAtEndOfStep = 1e-3;
// Place of a located point.
inline constexpr double kLocatedPlace = 1e-9;
// Scaled distance of a located point from its guess that is admitted on the shortest steps.
inline constexpr double kLocatedReach = 1e-9;
// Distance of a bifurcation from another event: up to the first they are one; up to the second, a shorter step tells.
inline constexpr double kCoincident = 1e-5;
// Scaled length along a curve at whose end rates tell what its start does not: where the load, or an inequality,
// changes with the third power of the arc length.
inline constexpr double kAhead = 1e-3;
// Scaled length of an increment of method mpec that stands for a rate.
inline constexpr double kShortIncrement = 1e-5;
// Newton step, relative to 1 + |x|, from which on the factors at hand are good enough to finish with.
inline constexpr double kReuseFactors = 1e-5;

}  // namespace contact_path::tolerances

#endif  // CONTACT_PATH_TOLERANCES_H_
