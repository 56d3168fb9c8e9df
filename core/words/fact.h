// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// What happened, as kind and values: everybody decides by these, and only the table of words makes text of
/// them.
namespace posewire::words {

enum class Kind : std::uint16_t {
    Nothing,
    Text,
    Names,
    NamesAndLast,
    NamesAndMore,
    Samples,
    Messages,
    Datagrams,
    Packets,
    Gaps,
    Streams,
    Characters,
    Share,
    Types,
    OfSender,
    Port,
    Lost,
    Incomplete,
    CauseThisComputer,
    CauseNetwork,
    CauseSender,
    CauseUnknown,
    CauseTransport,
    CauseProbe,
    // When something happened.
    Since,
    ToTheEnd,
    At,
    FromTo,
    Dated,
    // Incidents.
    SenderStarted,
    Loss,
    LostHere,
    Outage,
    Reordered,
    Duplicated,
    Malformed,
    NotMxtp,
    Restarted,
    OtherPort,
    StepChanged,
    StepIrregular,
    RateChanged,
    TypesEnded,
    TimeCodeJumped,
    TimeCodeFrozen,
    TimeCodeWasFrozen,
    TwoSenders,
    SentTwice,
    Contradiction,
    SendsCounts,
    SendsNoCounts,
    SendsTypeSinceJ,
    CountsComeAndGo,
    ReadInOtherUnit,
    UnitChanged,
    MetadataChanged,
    TagChanged,
    NullPoseChanged,
    // Content of no use.
    // clang-format off
    PoseFrozen, AnnouncedMissing, FingerSegments, OrientationsZero, OrientationsFar, NumbersNotFinite,
    PositionsAbsurd, NumbersSwapped, PelvisJumped, UnitLooks, IdsFromZero, IdsRepeat, ConventionLooks,
    ConventionUnknown, QuaternionXyzw, QuaternionInverse, UnityAxes, AllMirrored, PlacesMirrored,
    InBursts, ClocksApart, TimeCodesDrift, CounterStands, TimeCodeSpeed, FloorOff, LastNeverSet,
    PartNeverSent, OtherId, SharedPacket,
    // clang-format on
    Overtaken,
    RelayStopped,
    RecordingEnded,
    RecordingMoved,
    ProbeSilent,
    ClockSet,
    LossLimit,
    JitterLimit,
    GapLimit,
    AgeLimit,
    RateLimit,
    FragmentsLost,
    NotYetHere,
    TypesMissing,
    // What a loss rests on.
    WaitingForLate,
    NoEvidence,
    DropsUncounted,
    DroppedHere,
    NotListening,
    OvertakenBetween,
    LostOnWay,
    SampleDamaged,
    PartOfSample,
    PartOfMessage,
    AsStreamBegan,
    OtherStream,
    NotSentByTcp,
    HostsSilent,
    Paused,
    SenderPaused,
    // Verdicts.
    NoDataYet,
    NoPoseYet,
    NoFaultSoFar, ///< of a file while it is read
    Good,
    NotGood,
    NotQuiteGood,
    Over,
    GoingOn,
    Behind,
    NoPose,
    PoseDoubt,
    // Poses that were not sent as they are shown.
    OrientationsFitted,
    PositionsFitted,
    BodyFitted,
    NoPositions,
    NoOrientations,
    SegmentsSolved,
    SegmentsAssumed,
    SegmentsBroken,
    TurnsAssumed,
    LongerThanScale,
    ShorterThanScale,
    BonesMeasured,
    ReferenceBody,
    MeshScale,
    // clang-format off
    PlacedOnFloor, SentBelowFloor, TrackedObjects, Objects, PartlyAssumed, PartlySolved,
    // clang-format on
    WrongScale,
    AssumedBody,
    // What a sender follows, and how that is known.
    RevisionUnknown,
    RevisionE,
    RevisionJOrK,
    RevisionN,
    CountsInHeader,
    ReservedHeader,
    DeprecatedType,
    PelvisAt,
    ReachOf,
    UnitBy,
    ZUp,
    YUp,
    UprightAlong,
    // Null poses, errors.
    NameTwice,
    MoreNamesTwice,
    PartsMissing,
    TooLarge,
    FewerSegments,
    OtherUnit,
    StandsAskew,
    Mirrored,
    PartlyMirrored,
    PointsWithoutSegment,
    NotNumbers,
    // Warnings.
    PartsMissingNow,
    EarlierPartsMissing,
    NamesUnknown,
    NamesMoved,
    MoreSegments,
    MatricesUnusable,
    ScalesDisagree,
    NoScaleMessage,
    Stature,
    BelowFloor,
    PointIdsTwice,
    JointsApart,
    LengthsChanged,
    // Notes.
    EarlierPartsMissed,
    NamesRespelled,
    ScalesDiffer,
    DeprecatedScaleAlone,
    PelvisAtOrigin,
    AboveFloor,
    Asymmetric,
    PointNames,
    // Parts of these.
    LastPart,
    Beside,
    Numbered,
    MovedTo,
    LeftBy,
    ApartBy,
    KnownAs,
    RightSide,
    LeftSide,
    Parts,
    Segments,
    Props,
    Metres,
    Centimetres,
    Millimetres,
    Inches,
    // clang-format off
    // Connections.
    NoInput, CannotOpen, AddressGone, NotJoined, NotListenedTo, ForeignDatagrams, NotReachable, SilentPeer,
    GarbledPeer, NothingArrives, ListensOnly, NoListener, TcpRefused, TcpKnocked, OtherTransport, FirewallOn,
    WentSilent,
    Either, HostOn,
    // Formats of others.
    LooksLikeArtNet, LooksLikeHttp, LooksLikeDTrack, LooksLikeTransport, LooksLikeJson, LooksLikeRemote,
    LooksLikeTrigger, LooksLikeMvnx, LooksLikeXml, LooksLikeVmc, LooksLikeOsc, LooksLikeXtlp, LooksLikeNatNet,
    LooksLikeVicon, LooksLikeQualisys, LooksLikeMvn, LooksLikeFbx, LooksLikeCompressed, LooksLikeText,
    MxtpBehind, HoldsNoMxtp, HoldsLittleMxtp,
    // Files that were written.
    Exported, MarkerSamples, SamplesMissing, RestartedTimes, PauseLeftOut, GapsWithoutValues, GapsNull,
    GapsRepeat, GapsBridged, GapsUnmeasured, GapsLeftOut,
    // clang-format on
};
inline constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::GapsLeftOut) + 1;

/// A number with so many decimals; `isTrimmed`: without zeros at its end, as somebody set a limit.
struct Number {
    double value = 0;
    int decimals = 0;
    bool isTrimmed = false;
    friend bool operator==(const Number&, const Number&) = default;
};

struct NamedValue;

/// One thing to be said. The values are named as the placeholders of the table.
struct Fact {
    Fact(Kind what = Kind::Nothing);
    Fact(Kind what, std::vector<NamedValue> with);

    Kind kind;
    std::vector<NamedValue> values;

    [[nodiscard]] bool isNothing() const { return kind == Kind::Nothing; }
    friend bool operator==(const Fact& one, const Fact& other);
};

/// A name or address, a count, a measure, a list of names, or facts that are parts of this one.
using Value =
    std::variant<std::string, std::uint64_t, Number, std::vector<std::string>, Fact, std::vector<Fact>>;

struct NamedValue {
    std::string_view name; ///< a literal
    Value value;
    friend bool operator==(const NamedValue&, const NamedValue&) = default;
};

inline Fact::Fact(Kind what) : kind(what) {}
inline Fact::Fact(Kind what, std::vector<NamedValue> with) : kind(what), values(std::move(with)) {}

/// Null if the fact has no value of that name.
[[nodiscard]] const Value* find(const Fact& fact, std::string_view name);
/// Adds a value, in place of one of the same name.
void set(Fact& fact, std::string_view name, Value value);
/// Adds a value unless there is one of the same name.
void add(Fact& fact, std::string_view name, Value value);
/// A longer list is said as one shorter than this and how many more there are.
inline constexpr std::size_t kMostListed = 4;
/// Cuts the texts of a fact off, with "…" at their end, and its lists, which are said as before: they take
/// about so many bytes.
void clip(Fact& fact, std::size_t most);
[[nodiscard]] std::size_t memoryBytes(const Fact& fact);

/// "12 samples", of the kinds that count something: Samples, Datagrams and so on.
[[nodiscard]] inline Fact counted(Kind kind, std::uint64_t count) {
    return {kind, {{"n", count}}};
}
/// "type 02", "types 02, 12 and 20".
[[nodiscard]] Fact typesFact(const std::vector<std::uint8_t>& types);
[[nodiscard]] Fact sharedFact(std::uint8_t datagrams);

} // namespace posewire::words
