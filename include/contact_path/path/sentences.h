// The sentences that tell why a path ends; docs/end_reasons.md explains each.
#ifndef CONTACT_PATH_PATH_SENTENCES_H_
#define CONTACT_PATH_PATH_SENTENCES_H_

#include <string_view>

// EndText() puts in: <name>, <value>, <other> of the cause; <digits>, the value in up to six digits; <unknown>, what is
// not known of a sign. A sentence that ends with a colon goes on with the next cause.
namespace contact_path::sentences {

using Sentence = std::string_view;

// Why a path ends.
inline constexpr Sentence kStopCriterion = "<name>";
inline constexpr Sentence kProgramDone = "the program was traced to its end";
inline constexpr Sentence kMaxIncrements = "the wanted number of increments was accepted";
inline constexpr Sentence kCancelled = "the caller asked for it";
inline constexpr Sentence kClosedPath = "the path has come back to increment <value> and repeats from there on";
inline constexpr Sentence kNoMemoryAtStart = "there is not enough memory before increment 0";
inline constexpr Sentence kNoMemory = "there is not enough memory after increment <value>";
inline constexpr Sentence kNoSolutionAtStart = "<name>, before increment 0";
inline constexpr Sentence kNoSolution = "<name>, after increment <value>";
inline constexpr Sentence kConstantLoads = "while the constant loads were brought on:";
inline constexpr Sentence kAtLimit =
    "the machine can go no further on a stable path: at_limit jump tells where the structure lands, follow goes on";
inline constexpr Sentence kNoLanding =
    "the jump from increment <value> comes to no equilibrium: it was followed until a node had moved by <other>";
inline constexpr Sentence kNoJump =
    "the machine can go no further, and the jump from increment <value> comes back to where it began";
inline constexpr Sentence kMayGoOn =
    "no branch was found with which the load goes on, and there are too many combinations of contact states to try "
    "them all: see branch_rule";

// Where branches part, and where none leads on.
inline constexpr Sentence kNoBranch =
    "no admissible branch: the quasi-static path ends here, only a dynamic jump leads further";
inline constexpr Sentence kNoBranchFound =
    "no admissible branch was found among the combinations of contact states tried";
inline constexpr Sentence kOneFreeMotion =
    "no admissible branch, and the structure is a mechanism here: nothing resists 1 motion";
inline constexpr Sentence kFreeMotions =
    "no admissible branch, and the structure is a mechanism here: nothing resists <value> motions";
inline constexpr Sentence kBecameMechanism =
    "the structure has become a mechanism: it can move in several directions without any change of load and reactions";
inline constexpr Sentence kNoSuchBranch =
    "branch_choices wants branch <value> at <name>: the number of branches there is <other>";
inline constexpr Sentence kOnlyReactionsChange =
    "branch_choices wants a branch at increment <value>: only reactions change there, and the branches part in the "
    "increment before";
inline constexpr Sentence kSlidesOffObstacle =
    "contact <name> is lost: the node slides over the end of the obstacle while it is pressed onto it, and only a "
    "dynamic jump leads further";
inline constexpr Sentence kSlidesOffSurface =
    "contact <name> is lost: the node slides over the end of the surface while it is pressed onto it, and only a "
    "dynamic jump leads further";
inline constexpr Sentence kLimitPointOfLoads =
    "a limit point at <digits> of their full size; only a dynamic jump leads further";
inline constexpr Sentence kStandsAtEnd =
    "contact <name> stands at an end of its surface, over which a contact cannot slide";
inline constexpr Sentence kStandAtEnds =
    "contact <name> and <value> more stand at ends of their surfaces, over which a contact cannot slide";
inline constexpr Sentence kOpenBeyondTarget =
    "every contact is open, and the load factor has gone beyond minus its target and moves away from it; with a stop "
    "criterion the path goes on";
inline constexpr Sentence kOpenAndDrifts =
    "every contact is open, and the structure as a whole drifts away without a load; with a stop criterion the path "
    "goes on";
inline constexpr Sentence kFrictionEnds =
    "the friction of obstacle <name> falls to 0 at load factor <digits>: beyond, it would be negative";
inline constexpr Sentence kComesOff =
    "tendon <name> comes off its roller: nothing is left of the angle by which it is wrapped";
inline constexpr Sentence kHauled =
    "tendon <name> has been hauled by the arc on one side of its roller: what a turn of the roller hauls beyond is not "
    "described";
inline constexpr Sentence kStringTurns =
    "tendon <name> has turned by nearly half a turn beside a roller: what it is wrapped by is not known beyond";
inline constexpr Sentence kMeetsRoller =
    "tendon <name> has next to nothing left between two rollers, or a node and one";

// Steps and points that are refused.
inline constexpr Sentence kNoIncrement = "no increment could be accepted, however short:";
inline constexpr Sentence kNewtonLeavesBranch = "Newton's method does not stay on the branch";
inline constexpr Sentence kResiduals = "the residuals of the next point are too large";
inline constexpr Sentence kEventsInPlace = "contacts change their states again and again in one place";
inline constexpr Sentence kReactionsAtRest = "the reactions with which a branch begins are not in equilibrium";
inline constexpr Sentence kBranchLost = "the branch from an event could not be followed";
inline constexpr Sentence kStartNoEquilibrium = "the start is not an equilibrium";
inline constexpr Sentence kResumeNoEquilibrium = "the increment to go on from is not an equilibrium";
inline constexpr Sentence kResumeLost = "the path cannot be followed from the increment to go on from";
inline constexpr Sentence kTooManyIncrements = "too many increments";

// Increments by Ipopt: accepted, or why not.
inline constexpr Sentence kAccepted = "accepted";
inline constexpr Sentence kNotSolved = "the increment problem was not solved";
inline constexpr Sentence kResidual = "the residuals of the solution are too large";
inline constexpr Sentence kContradiction = "the regularised solution contradicts its own contact states";
inline constexpr Sentence kTooLong = "the solution is a jump, far longer than the wanted increment";
inline constexpr Sentence kNoProgress = "the increment problem has no solution but the point itself";
inline constexpr Sentence kWrongDirection = "the load factor changes against the wanted direction";
inline constexpr Sentence kTurnedBack = "the path turns sharply without a change of contact state";
inline constexpr Sentence kBackAtRest =
    "the load goes back with all contacts at rest, and no branch was found that slides";
inline constexpr Sentence kNotConfirmed = "two half increments do not confirm the change of contact state";
inline constexpr Sentence kBeyondTarget = "the load factor goes past its target, and no point at the target is found";

// Values whose sign is not known, in units of the scene; rates are per unit of arc length.
inline constexpr Sentence kReactionSign = "the sign of the reaction of contact <name> <unknown>";
inline constexpr Sentence kStiffnessSign = "the sign of the stiffness of the parts at contact <name> <unknown>";
inline constexpr Sentence kSlipSign = "the sign of the slip per load factor of contact <name> <unknown>";
inline constexpr Sentence kMotionSign = "the sign of the motion along the path <unknown>";
inline constexpr Sentence kGapRateSign = "the sign of the rate of the gap of contact <name> <unknown>";
inline constexpr Sentence kReactionRateSign = "the sign of the rate of the reaction of contact <name> <unknown>";
inline constexpr Sentence kMarginRateSign = "the sign of the rate of the friction margin of contact <name> <unknown>";
inline constexpr Sentence kSlipRateSign = "the sign of the rate of the slip of contact <name> <unknown>";
inline constexpr Sentence kPatchRateSign =
    "the sign of the rate towards the next piece of the surface of contact <name> <unknown>";

inline constexpr Sentence kBarRateSign = "the sign of the rate with which bar <name> goes slack or taut <unknown>";

// What explains an end.
inline constexpr Sentence kCollapsedBar = "bar <name> has shrunk to <value> of its initial length";
inline constexpr Sentence kCollapsedSpan =
    "what tendon <name> has between two nodes has shrunk to <value> of its initial length";
inline constexpr Sentence kInvertedElement =
    "element <name> turns inside out: its area has shrunk to <value> of the initial one";
inline constexpr Sentence kLockingSolids =
    "<name>: elements of 3 or 4 nodes are far too stiff in plane strain where nu is beyond 0.48; take 8 nodes";
inline constexpr Sentence kSlenderBeam =
    "EA L^2 / EI of beam <name> is <value>: rounding of its axial force hides its bending; where it hardly stretches, "
    "EA with 1e7 gives nearly the path";
inline constexpr Sentence kLightLoads =
    "rounding of the coordinates makes forces of <value> of the constant loads: of softer parts, the path is more "
    "exact";
inline constexpr Sentence kOnCurve = "contact <name> is pressed onto a curve of the radius <value>";
inline constexpr Sentence kCurveTurnsReaction =
    "contact <name> is pressed onto a curve of the radius <value>: rounding of the coordinates turns its reaction by "
    "<other> rad";
inline constexpr Sentence kCurveHidesStiffness =
    "contact <name> is pressed onto a curve of the radius <value>: reaction over radius is <other> of the "
    "characteristic stiffness, which is lost in rounding beside it";
inline constexpr Sentence kHalfRound =
    "with holonomic friction a node cannot slide beyond half a round of a closed obstacle";
inline constexpr Sentence kOverrun =
    "contact <name>: another part of the surface comes over the node while it touches, and contact with two parts of "
    "a surface at a time is not covered";
inline constexpr Sentence kIsClamped =
    "<name> gives way by more than a millionth of the characteristic length, as where rigid bodies are clamped, or "
    "where forces are a hundred times those of the scene: loads are to be written at the size that they reach";
inline constexpr Sentence kTouchesTwice =
    "contact <name>: the circle comes upon another part of the obstacle while it touches, and what it touches twice "
    "has to be two obstacles";
inline constexpr Sentence kBehindSurface =
    "contact <name>: the node has come past an end of the surface to <value> behind it";
inline constexpr Sentence kBehindObstacle =
    "contact <name>: the node has come past an end of the obstacle to <value> behind it; nodes may be on the left of "
    "the curve";
inline constexpr Sentence kPulls = "contact <name> pulls with <value>, and the error of its reaction is <other>";

// Remarks.
inline constexpr Sentence kMissedTarget = "the target of stage <value> of <other> was not reached";
inline constexpr Sentence kNoCriterion = "no stop criterion was given";
inline constexpr Sentence kMissedCriteria = "no stop criterion was met (<name>)";
inline constexpr Sentence kMissedChoices = "branch_choices: never came to <name>";
inline constexpr Sentence kFreeNodes = "<name>";
inline constexpr Sentence kFreeWithoutLoad = "without a load, <name>";
inline constexpr Sentence kOtherReactions =
    "where several contacts hold a node its reactions are not unique: the least ones were taken";
inline constexpr Sentence kTurnsBack =
    "at increment <value> the load turns back, since that dissipates most, where another branch goes on with it: see "
    "branch_rule";
inline constexpr Sentence kTurnsBackOften =
    "at increment <value> the load turns back, since that dissipates most, where another branch goes on with it (the "
    "first of <other> such increments): see branch_rule";
inline constexpr Sentence kNoneGoesOn =
    "at increment <value> no branch goes on, and the path was followed back: see at_limit";
inline constexpr Sentence kInObstacles = "nodes that are no candidates have gone into obstacles: <name>";
inline constexpr Sentence kShortPath =
    "the whole path is hardly longer than what increments may cut off: to be trusted only with a smaller step";

}  // namespace contact_path::sentences

#endif  // CONTACT_PATH_PATH_SENTENCES_H_
