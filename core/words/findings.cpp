// SPDX-License-Identifier: MIT
#include "core/words/say.h"

#include <algorithm>
#include <array>

/// What is found out about null poses and connections, and what was written.
namespace posewire::words {
namespace {

using K = Kind;

constexpr Text kElsewhere{"Another program sends to this port: stop it, or have MVN send to another port and "
                          "listen there."};
constexpr Text kNoFile{"Posewire reads recordings of MXTP: pcap, pcapng, or datagrams back to back."};

constexpr std::array kFindings{
    // Null poses. The headline of an error is a clause after a colon.
    Wording{.kind = K::NameTwice,
            .headline = {"the name \"{name}\" occurs twice: for segments {from} and {to}"},
            .sentence = {"The name \"{name}\" occurs twice: for segments {from} and {to}."},
            .advice = {"Receivers that go by names mix the two up; Posewire goes by the order."}},
    Wording{.kind = K::MoreNamesTwice,
            .headline = {"{n} more segments have a name that occurred before",
                         "{n} more segment has a name that occurred before"},
            .sentence = {"{n} more segments have a name that occurred before.",
                         "{n} more segment has a name that occurred before."},
            .advice = {"Receivers that go by names mix them up; Posewire goes by the order."}},
    Wording{
        .kind = K::PartsMissing,
        .sentence =
            {"[Parts {parts}|The last part][ of {all}] of the newest scale message never came; {count} did.",
             "[Part {parts}|The last part][ of {all}] of the newest scale message never came; {count} did."},
        .advice = {"Segments or points are missing below. Parts get lost on the way, mostly if the network "
                   "drops datagrams[; the next message is due every {seconds} s]."}},
    Wording{
        .kind = K::TooLarge,
        .headline = {"{n} segments and points were left out: the scale message takes more than {limit} KB",
                     "{n} segment or point was left out: the scale message takes more than {limit} KB"},
        .sentence = {"{n} segments and points were left out: the scale message takes more than {limit} KB.",
                     "{n} segment or point was left out: the scale message takes more than {limit} KB."},
        .advice = {"MVN's take a tenth of it: this sender is not MVN."}},
    Wording{
        .kind = K::FewerSegments,
        .sentence = {"The scale message has {count}, the poses have {all} ({body} body, {props}, {fingers} "
                     "fingers)."},
        .advice = {"The figure is drawn with the reference body instead of this one."}},
    Wording{.kind = K::OtherUnit,
            .headline = {"the body is {height} units tall: that looks like {looks} ({metres} m); the "
                         "specification's unit is the metre"},
            .sentence = {"The body is {height} units tall: that looks like {looks} ({metres} m); the "
                         "specification's unit is the metre."},
            .advice = {"Receivers draw a giant. Set the sender's unit, or scale by {factor}."}},
    Wording{
        .kind = K::StandsAskew,
        .headline = {"the body stands along {axis}; the specification's null pose stands along z"},
        .sentence = {"The body stands along {axis}; the specification's null pose stands along z."},
        .advice =
            {"[The sender writes {written} data. Figures made from this message lie on the floor.|Figures "
             "made from this message lie on the floor or stand on their heads.]"}},
    Wording{.kind = K::Mirrored,
            .headline = {"left and right are exchanged: the right arm and leg lie towards +y, where the left "
                         "belongs"},
            .sentence = {"Left and right are exchanged: the right arm and leg lie towards +y, where the left "
                         "belongs."},
            .advice = {"The body is mirrored, or looks towards −x. Figures are twisted unless poses are "
                       "mirrored too."}},
    Wording{.kind = K::PartlyMirrored,
            .headline = {"{n} of {all} segments lie on the wrong side, {name} first"},
            .sentence = {"{n} of {all} segments lie on the wrong side, {name} first."},
            .advice = {"Figures are torn at these segments."}},
    Wording{.kind = K::PointsWithoutSegment,
            .headline = {"{n} points on segments that do not exist: {names}; there are {all}",
                         "{n} point on segments that do not exist: {names}; there are {all}"},
            .sentence = {"{n} points on segments that do not exist: {names}; there are {all}.",
                         "{n} point on segments that do not exist: {names}; there are {all}."},
            .advice = {"Markers and meshes cannot use them; they are in no picture."}},
    Wording{.kind = K::NotNumbers,
            .headline = {"positions that are no numbers: {names}"},
            .sentence = {"Positions that are no numbers: {names}."},
            .advice = {"The reference body's origins are used for these segments."}},
    Wording{
        .kind = K::PartsMissingNow,
        .sentence =
            {"[Parts {parts}|The last part][ of {all}] of the newest scale message never came; {count} did.",
             "[Part {parts}|The last part][ of {all}] of the newest scale message never came; {count} did."},
        .advice = {"An earlier message is shown. Parts get lost on the way, mostly if the network drops "
                   "datagrams[; the next message is due every {seconds} s]."}},
    Wording{.kind = K::EarlierPartsMissing,
            .sentence = {"{n} earlier scale messages arrived incomplete.",
                         "{n} earlier scale message arrived incomplete."},
            .advice = {"Segments or points are missing below. The network loses datagrams, or the sender "
                       "leaves them out."}},
    Wording{.kind = K::NamesUnknown,
            .sentence = {"{n} segment names are not in the specification: {names}.",
                         "{n} segment name is not in the specification: {names}."},
            .advice = {"Posewire goes by the order of the segments; receivers that go by names lack these."}},
    Wording{
        .kind = K::NamesMoved,
        .sentence = {"The names come in another order than the specification's: {names}."},
        .advice = {"Receivers that go by the order put these origins on the wrong segments. Posewire goes "
                   "by the names if all 23 are there once, else by the order."}},
    Wording{
        .kind = K::MoreSegments,
        .sentence = {"The scale message has {count}, the poses have {all} ({body} body, {props}, {fingers} "
                     "fingers)."},
        .advice = {"The origins of some segments of the poses are not known."}},
    Wording{.kind = K::MatricesUnusable,
            .sentence = {"Type 10 has no usable matrix or offset for segments {segments}: a scale must not "
                         "turn a segment inside out or flatten it.",
                         "Type 10 has no usable matrix or offset for segment {segments}: a scale must not "
                         "turn a segment inside out or flatten it."},
            .advice = {"An avatar made from it loses these parts."}},
    Wording{.kind = K::ScalesDisagree,
            .sentence = {"Types 10 and 13 disagree: the null pose without the offsets of type 10 is no human "
                         "body at {segments}."},
            .advice = {"One of the two belongs to another performer. Type 13 is used; type 10 is deprecated "
                       "since revision J."}},
    Wording{.kind = K::NoScaleMessage,
            .sentence = {"Poses have come for {lasted} s and no scale message (type 13)."},
            .advice = {"The figure has the size of the reference body, {height} m: feet may float, sink or "
                       "slide."}},
    Wording{.kind = K::Stature,
            .sentence = {"The body is {height} m tall, which no person is."},
            .advice = {"Body dimensions were entered wrongly, or the sender is not MVN."}},
    Wording{
        .kind = K::BelowFloor,
        .sentence = {"{n} segments below the floor: {names}.", "{n} segment below the floor: {names}."},
        .advice = {"In MVN's null pose the balls of the feet are at z = 0. Meshes fitted to it sink in."}},
    Wording{.kind = K::PointIdsTwice,
            .sentence = {"{n} point IDs given twice: {names}.", "{n} point ID given twice: {names}."},
            .advice = {"Joint angles and markers name points by these IDs: which one is meant is open."}},
    Wording{.kind = K::JointsApart,
            .sentence = {"Points and segments disagree about {n} joints: {names}.",
                         "Points and segments disagree about {n} joint: {names}."},
            .advice = {"Meshes scaled by points do not fit the segments they are moved by."}},
    Wording{.kind = K::LengthsChanged,
            .sentence = {"{n} lengths changed in mid-stream: {names}.",
                         "{n} length changed in mid-stream: {names}."},
            .advice = {"The sender was recalibrated or loaded another body. Poses before and after belong to "
                       "bodies of different size: do not compare or join them without rescaling."}},
    Wording{.kind = K::EarlierPartsMissed,
            .sentence = {"{n} earlier scale messages arrived incomplete.",
                         "{n} earlier scale message arrived incomplete."},
            .advice = {"The body that is shown is complete."}},
    Wording{.kind = K::NamesRespelled,
            .sentence = {"{n} segment names are spelled otherwise than in the specification: {names}.",
                         "{n} segment name is spelled otherwise than in the specification: {names}."},
            .advice = {"Receivers that compare names letter by letter do not find these segments."}},
    Wording{.kind = K::ScalesDiffer,
            .sentence = {"Type 10 has {count}, type 13 {all}."},
            .advice = {"Type 13 is used; type 10 is deprecated since revision J."}},
    Wording{.kind = K::DeprecatedScaleAlone,
            .sentence = {"Only type 10 was sent: it says how segments differ from a body that no "
                         "specification describes."},
            .advice = {"The figure has the size of the reference body, {height} m: feet may float, sink or "
                       "slide."}},
    Wording{.kind = K::PelvisAtOrigin,
            .sentence = {"The pelvis is at the origin and the feet are {height} m below it."},
            .advice = {"Upper-body configurations send it like this. Ghost and figure are put on the floor "
                       "with their lowest point."}},
    Wording{.kind = K::AboveFloor,
            .sentence = {"The body hangs {height} m above the floor."},
            .advice = {"In MVN's null pose the balls of the feet are at z = 0. Meshes fitted to it float."}},
    Wording{.kind = K::Asymmetric,
            .sentence = {"Left and right differ by 5 mm or more: {names}."},
            .advice = {"MVN measures one side for both. The other side was entered by hand, or the body was "
                       "edited."}},
    Wording{
        .kind = K::PointNames,
        .sentence = {"{n} points have unfamiliar names: {names}.",
                     "One point has an unfamiliar name: {names}."},
        .advice = {"The point list may be from another version. Check the IDs before using points by ID."}},
    // Parts of these.
    Wording{.kind = K::LastPart, .headline = {"the last"}},
    Wording{.kind = K::Beside, .headline = {"{name} {value}"}},
    Wording{.kind = K::Numbered, .headline = {"{n} \"{name}\""}},
    Wording{.kind = K::MovedTo, .headline = {"{name} at {n} (should be {to})"}},
    Wording{.kind = K::LeftBy, .headline = {"{name} (left {value})"}},
    Wording{.kind = K::ApartBy, .headline = {"{name} by {value} mm"}},
    Wording{.kind = K::KnownAs, .headline = {"{name} {value} (elsewhere {known})"}},
    Wording{.kind = K::RightSide, .headline = {"right {name} {value}"}},
    Wording{.kind = K::LeftSide, .headline = {"left {name} {value}"}},
    Wording{.kind = K::Parts, .headline = {"{n} parts", "{n} part"}},
    Wording{.kind = K::Segments, .headline = {"{n} segments", "{n} segment"}},
    Wording{.kind = K::Props, .headline = {"{n} props", "{n} prop"}},
    Wording{.kind = K::Metres, .headline = {"metres"}},
    Wording{.kind = K::Centimetres, .headline = {"centimetres"}},
    Wording{.kind = K::Millimetres, .headline = {"millimetres"}},
    Wording{.kind = K::Inches, .headline = {"inches"}},
    // Connections.
    Wording{.kind = K::NoInput,
            .sentence = {"No port is open."},
            .advice = {"Add UDP port 9763, MVN's default."}},
    Wording{.kind = K::CannotOpen, .sentence = {"Not listening: {problem}."}},
    Wording{.kind = K::AddressGone, .sentence = {"An input receives nothing: {problem}."}},
    Wording{.kind = K::NotJoined,
            .sentence = {"Not listening to all groups: {problem}."},
            .advice = {"Check that the network is connected; it is tried again whenever it changes."}},
    Wording{.kind = K::NotListenedTo,
            .sentence = {"{n} datagrams have arrived from hosts that are not listened to.",
                         "{n} datagram has arrived from hosts that are not listened to."},
            .advice = {"Add the sender's address under Listen only to, or leave that empty."}},
    Wording{
        .kind = K::ForeignDatagrams,
        .sentence = {"{n} datagrams from {address}[ ({ports} ports)] are not MXTP; the newest begins with "
                     "{value}[, which looks like {looks}].",
                     "{n} datagram from {address} is not MXTP; it begins with {value}[, which looks like "
                     "{looks}]."},
        .advice = {"[{looks}|Another program sends to this port: stop it, or have MVN send to another port "
                   "and listen there.]"}},
    Wording{.kind = K::NotReachable,
            .sentence = {"{problem}."},
            .advice = {"Check host and port, and that the sender listens; MVN itself does not listen but "
                       "connects: for MVN, listen on a TCP port here."}},
    Wording{.kind = K::SilentPeer,
            .sentence = {"{address} is connected by TCP and has sent nothing for {lasted} s."},
            .advice = {"In MVN: Options > Preferences > Network Streamer, switch on datagrams to send, and "
                       "press play or switch on Send Paused."}},
    Wording{.kind = K::GarbledPeer,
            .sentence = {"{address} is connected by TCP, and none of its {n} bytes are MXTP."},
            .advice = {"Another program has connected to this port: stop it, or listen on another port."}},
    Wording{.kind = K::NothingArrives,
            .sentence = {"Nothing has arrived on {protocol} port {port}."},
            .advice = {"In MVN: Options > Preferences > Network Streamer, host [{host}|the address of this "
                       "computer], port {port}, protocol {protocol}."}},
    Wording{.kind = K::ListensOnly,
            .sentence = {"Listening only on {host}; this computer also has {others}, where it does not "
                         "listen."},
            .advice = {"Have MVN send to {host}, or listen on all addresses."}},
    Wording{.kind = K::NoListener,
            .sentence = {"{n} datagrams have come to ports of this computer where no program listens.",
                         "{n} datagram has come to a port of this computer where no program listens."},
            .advice = {"If it is MVN: set its port to {port}, or listen on its port here; its Isaac Teleop "
                       "preset sends to 9764."}},
    Wording{.kind = K::TcpRefused,
            .sentence = {"This computer has refused {n} TCP connections: no program listens at their port.",
                         "This computer has refused {n} TCP connection: no program listens at its port."},
            .advice = {"If it is MVN: set Protocol to UDP in its Network Streamer, or add a TCP "
                       "listener here."}},
    Wording{.kind = K::TcpKnocked,
            .sentence = {"{address} connects by TCP to port {port}, which is open for UDP alone."},
            .advice = {"If it is MVN: set Protocol to UDP in its Network Streamer, or add a TCP "
                       "listener here."}},
    Wording{.kind = K::OtherTransport,
            .sentence = {"Only {protocol} inputs are open; a sender that uses {other} would go unnoticed."},
            .advice = {"Check Protocol in MVN's Network Streamer, or listen for {other} as well."}},
    Wording{
        .kind = K::FirewallOn,
        .sentence = {"A firewall ({name}) is active on this computer and may block datagrams; Posewire "
                     "cannot read its rules."},
        .advice = {"[To let them in: {command}|Ask the administrator to accept {protocol} port {port}.]"}},
    Wording{.kind = K::WentSilent,
            .sentence = {"No data for {lasted} s."},
            .advice = {"Check that MVN is playing and streaming: while paused it sends only with Send Paused "
                       "on."}},
    Wording{.kind = K::Either, .headline = {"{first} or {second}"}},
    Wording{.kind = K::HostOn, .headline = {"{address} ({name})"}},
    Wording{.kind = K::LooksLikeArtNet, .headline = {"Art-Net (lighting)"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeHttp, .headline = {"HTTP (a web browser)"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeDTrack, .headline = {"ART DTrack"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeTransport,
            .headline = {"MVN's transport messages (JSON)"},
            .advice = {"They tell of play and record and hold no pose. In MVN: Options > Preferences > "
                       "Network Streamer, switch on datagrams to send."}},
    Wording{.kind = K::LooksLikeJson,
            .headline = {"JSON text (Rokoko or another program)"},
            .advice = kElsewhere},
    Wording{.kind = K::LooksLikeRemote,
            .headline = {"MVN's remote control (XML)"},
            .advice = {"Have the program that controls MVN send to MVN's computer, usually to port 6004."}},
    Wording{.kind = K::LooksLikeTrigger,
            .headline = {"capture triggers (XML, of Vicon, Qualisys or Motive)"},
            .advice = {"Have the triggers sent to the computer that records, usually to port 30 or 1512."}},
    Wording{.kind = K::LooksLikeMvnx,
            .headline = {"MVNX (MVN's export in XML)"},
            .advice = {"MVNX holds no datagrams: open the recording in MVN and play it with the Network "
                       "Streamer on."}},
    Wording{.kind = K::LooksLikeXml, .headline = {"XML text"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeVmc, .headline = {"VMC (OSC of avatar programs)"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeOsc, .headline = {"OSC"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeXtlp,
            .headline = {"XTLP (MVN's Isaac Teleop preset)"},
            .advice = {"In MVN: Options > Preferences > Network Streamer, choose Position + Orientation "
                       "(Quaternion) instead of Isaac Teleop."}},
    Wording{.kind = K::LooksLikeNatNet, .headline = {"NatNet (OptiTrack Motive)"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeVicon, .headline = {"Vicon's object stream"}, .advice = kElsewhere},
    Wording{.kind = K::LooksLikeQualisys,
            .headline = {"Qualisys QTM's real-time protocol"},
            .advice = kElsewhere},
    Wording{.kind = K::LooksLikeMvn,
            .headline = {"a recording of MVN"},
            .advice = {"Only MVN reads it: open it there and play it with the Network Streamer on."}},
    Wording{.kind = K::LooksLikeFbx, .headline = {"FBX (a 3D file)"}, .advice = kNoFile},
    Wording{
        .kind = K::LooksLikeCompressed, .headline = {"a compressed file"}, .advice = {"Unpack it first."}},
    Wording{.kind = K::LooksLikeText, .headline = {"plain text"}, .advice = kNoFile},
    Wording{.kind = K::MxtpBehind,
            .headline = {"MXTP behind {n} other bytes (a tunnel, or a length prefix)",
                         "MXTP behind {n} other byte (a tunnel, or a length prefix)"},
            .advice = {"Have it sent without what comes before it."}},
    Wording{.kind = K::HoldsNoMxtp,
            .sentence = {"has no MXTP datagram and is no capture (pcap, pcapng)[; it looks like {looks}]."},
            .advice = {"[{looks}|Is it a recording of MXTP?]"}},
    Wording{.kind = K::HoldsLittleMxtp,
            .sentence = {"has {n} MXTP datagrams, but {value} of its {all} bytes belong to none[; it looks "
                         "like {looks}].",
                         "has {n} MXTP datagram, but {value} of its {all} bytes belong to none[; it looks "
                         "like {looks}]."},
            .advice = {"[{looks}|Record the network itself: pcap, pcapng, or datagrams back to back.]"}},
    // Files that were written.
    Wording{.kind = K::Exported, .headline = {"{name}: {samples} to {path}[; {missing}][; {restarts}]"}},
    Wording{.kind = K::MarkerSamples, .headline = {"{n} samples of markers", "{n} sample of markers"}},
    Wording{.kind = K::SamplesMissing, .headline = {"{n} are missing: {gaps}", "{n} is missing: {gaps}"}},
    Wording{.kind = K::RestartedTimes,
            .headline = {"its sender was restarted {n} times[: {pause}]",
                         "its sender was restarted {n} time[: {pause}]"}},
    Wording{.kind = K::PauseLeftOut, .headline = {"the pause is left out"}},
    Wording{.kind = K::GapsWithoutValues, .headline = {"a row without values"}},
    Wording{.kind = K::GapsNull, .headline = {"an object whose segments are null"}},
    Wording{.kind = K::GapsRepeat, .headline = {"the pose before it once more"}},
    Wording{.kind = K::GapsBridged, .headline = {"bridged evenly"}},
    Wording{.kind = K::GapsUnmeasured, .headline = {"points without a measurement"}},
    Wording{.kind = K::GapsLeftOut, .headline = {"a frame left out"}},
};
static_assert(std::ranges::is_sorted(kFindings, std::ranges::less(), &Wording::kind));

} // namespace

std::span<const Wording> findingWordings() {
    return kFindings;
}

} // namespace posewire::words
