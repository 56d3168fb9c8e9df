// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_reader.h"
#include "core/model/body/reference_body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::exporting {

/// A file that is written in large pieces. After a failure what is written goes nowhere.
class MotionOutput {
public:
    explicit MotionOutput(std::unique_ptr<log::ByteSink> sink) : m_sink(std::move(sink)) {}

    void write(std::string_view bytes);
    /// Last of all: without it the file does not come to be. Says what failed first.
    [[nodiscard]] tl::expected<void, log::FileError> finish();
    /// The writer cannot go on: what is wrong and what to do.
    void fail(std::string text);
    [[nodiscard]] bool hasFailed() const { return !m_result; }

private:
    void flush();

    std::unique_ptr<log::ByteSink> m_sink;
    std::string m_buffer;
    tl::expected<void, log::FileError> m_result;
};

/// Joint of a skin: a segment of the body or of its hands, or one that no segment is and that moves with one.
struct BodyJoint {
    std::string name; ///< "RightForeArm bend 2"; empty of segments
    int slot = 0;     ///< in model::kAllSegments: the segment that it is or moves with
    Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< in the null pose that the mesh was made for
    bool isShifted = false;                           ///< its origin leaves that of its segment
};

/// A skinned body in the null pose of a performer, from whoever has one: core has none. Metres, Z-up,
/// triangles counter-clockwise seen from outside.
struct BodyMesh {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<float, 3>> normals;       ///< of unit length, one for each position
    std::vector<std::array<std::uint8_t, 4>> joints; ///< places in `skeleton` that move it, each once
    std::vector<std::array<float, 4>> weights;       ///< of these; sum 1
    std::vector<std::uint32_t> indices;              ///< three for each triangle
    std::vector<BodyJoint> skeleton;
    /// Writes the pose in the world of each joint of `skeleton` for the poses of model::kAllSegments.
    std::function<void(std::span<const model::SegmentPose>, std::span<model::SegmentPose>)> pose;
};

/// Origins in the null pose of model::kAllSegments; not finite for those of which no sample has any.
using SegmentPlaces = std::array<Eigen::Vector3d, model::kMaxSegmentCount>;
/// The body of a performer with these segment origins. Hands without fingers are at rest.
using MakeBodyMesh = std::function<BodyMesh(const SegmentPlaces&)>;

/// All of it outlives the writer.
struct MotionTask {
    const feed::PoseSource& source;
    const MotionSurvey& survey;
    std::vector<std::size_t> characters; ///< of this file, places in the source: each has frames
    std::string application;             ///< name and version of who writes it
    MakeBodyMesh makeBody;               ///< empty: figures have no body, only joints

    [[nodiscard]] const feed::PoseCharacter& characterAt(std::size_t place) const {
        return source.characters[place];
    }
    [[nodiscard]] const CharacterSurvey& surveyAt(std::size_t place) const {
        return survey.characters[place];
    }
    /// Returns when it was received; empty of a gap, and if the file does not say.
    [[nodiscard]] std::optional<log::WallTime> receiptOf(const MotionFrame& frame) const {
        return frame.isGap() || !characterAt(frame.character).hasReceipt
                   ? std::nullopt
                   : std::optional(source.log->timeline().wallOf(frame.pose->stamp));
    }
    [[nodiscard]] bool hasTimeOfDay() const {
        return std::ranges::any_of(characters, [this](std::size_t place) {
            return std::ranges::any_of(characterAt(place).parts, &feed::PoseCharacter::Part::sendsTimeOfDay);
        });
    }
};

/// Writes one file of a format.
class MotionWriter {
public:
    MotionWriter() = default;
    virtual ~MotionWriter() = default;
    MotionWriter(const MotionWriter&) = delete;
    MotionWriter& operator=(const MotionWriter&) = delete;

    virtual void begin(MotionOutput&) {}
    virtual void add(const MotionFrame& frame, MotionOutput& out) = 0;
    virtual void finish(MotionOutput&) {}
};

/// One table (RFC 4180, UTF-8, lines end with CR LF), a row for each sample of each character, with the
/// columns
///
///     character,id,run,sample,time (s),received (ns since 1970 UTC),time code (ms),time of day,type,
///     Pelvis x (m),Pelvis y (m),Pelvis z (m),Pelvis qw,Pelvis qx,Pelvis qy,Pelvis qz, … all other segments,
///     Pelvis from, … all other segments
///
/// `run` counts from 1: a restart of the sender begins the next. `sample` is the sender's counter, `time`
/// counts from the first sample of the file by that, `type` is the message it came in. Positions are of
/// segment origins in the world (Z up), quaternions turn segment coordinates into world coordinates; "from"
/// is "sent", "solved" or "assumed", the weaker of both. The row of a sample that did not come whole has no
/// cells after `time`; of a file that does not say when its datagrams were received, `received` is empty; a
/// segment that a sample lacks has empty cells. Columns are those of all segments that any sample has: body,
/// props, left and right fingers. "time of day" (HH:MM:SS.mmm) is type 25 of the same sample, empty if that
/// did not come; there is no such column if no character of the file sends it.
[[nodiscard]] std::unique_ptr<MotionWriter> makeMotionCsv(const MotionTask& task);

/// One object on each line, in the same order:
///
///     {"character":"…","id":0,"run":1,"sample":1,"time":0.000000,"receivedNs":…,"timeCode":…,
///      "timeOfDay":"HH:MM:SS.mmm","type":"02","segments":[{"id":1,"name":"Pelvis","position":[x,y,z],"orientation":[w,x,y,z],
///       "from":"sent"},…]}
///
/// Units as in the table; "id" of a segment is its place in the message, from 1. Of a sample that did not
/// come whole "segments" is null, and what is between "time" and that is missing; "receivedNs" is missing
/// if the file does not say, "timeOfDay" if type 25 of the sample did not come.
[[nodiscard]] std::unique_ptr<MotionWriter> makeMotionJsonLines(const MotionTask& task);

/// Biovision hierarchy of one character: body and fingers, without props. Y up, Z forward, centimetres,
/// degrees. Offsets are those of the null pose (see skeletonOf()); the pelvis has position and rotation, all
/// others rotation alone (Z, X, Y in this order, R = Rz·Rx·Ry): joints stand where bones of constant length
/// put them. The frame time is that of the stream, and each sample is a frame: one that did not come whole
/// repeats the pose before it, and a restart of the sender leaves no pause.
[[nodiscard]] std::unique_ptr<MotionWriter> makeBvh(const MotionTask& task);

/// Binary glTF 2.0: each character a node with its segments as joints, and a skinned body where the task has
/// one, whose joints without a segment are leaves below theirs; one animation moves all. Metres, Y up, Z
/// forward. Joints have position and rotation, so that each stands exactly where its segment was sent. Keys
/// are at the samples' times (MotionFrame::seconds): a sample that did not come whole has none, so players go
/// on evenly from the one before to the next.
[[nodiscard]] std::unique_ptr<MotionWriter> makeGlb(const MotionTask& task);

/// C3D of one character (c3d.org, Intel byte order, floats): the markers of type 03 where those were sent,
/// else the origins of its segments. Millimetres, Z up. Each sample is a frame; what did not come is a point
/// without a measurement (residual -1). From 65,536 frames on their number is in TRIAL and in
/// POINT:LONG_FRAMES.
[[nodiscard]] std::unique_ptr<MotionWriter> makeC3d(const MotionTask& task);

/// MVNX, version 4, of one character: XML in the order of the vendor's own files, without empty parts.
/// Metres, Z up, quaternions w x y z. It has what was sent or follows from it: the 23 segments of the body
/// with the points of the null pose, the joints, the null pose as the frames `identity`, `tpose` and
/// `tpose-isb`, and of each sample orientation, position and joint angles (degrees). The comment of the
/// subject says whether the null pose was sent. `tc` is the time of day of type 25, or if that did not come
/// the time code of the header, `configuration` UpperBody if the pelvis stays at the origin with the feet
/// below, else FullBody. Sensors, velocities, contacts, props and fingers are not in it. A sample that did
/// not come whole has no frame; `index` counts it.
[[nodiscard]] std::unique_ptr<MotionWriter> makeMvnx(const MotionTask& task);

/// The words of model::Provenance, by its values.
inline constexpr std::array<std::string_view, 4> kProvenanceNames{"", "assumed", "solved", "sent"};

/// Archive of numpy (.npz) of one character, without objects that need pickle. n rows, one for each sample, s
/// segments: body, props, fingers.
///
///     time [n] f8 s; position [n, s, 3] f4 m, Z up; orientation [n, s, 4] f4 w x y z, world from segment;
///     provenance [n, s] u1, place in provenance_names; names [s]; sample [n] u4, run [n] u4;
///     time_code_ms [n] i8; received_ns [n] i8 since 1970 UTC; type [n] u1;
///     time_of_day_ms [n] i8 of type 25, if the character sends it
///
/// Of a sample that did not come whole, and of a segment that it lacks, position and orientation are NaN and
/// provenance is 0; of the former, time code and receipt are -1 and the type is 0. A receipt that the file
/// does not say is -1 too, and a time of day that did not come. The values wait in a file without a name
/// until the last one is there: memory stays bounded.
[[nodiscard]] std::unique_ptr<MotionWriter> makeNumpy(const MotionTask& task);

/// The fewest digits that read back to the same 32 bits.
void appendNumber(double value, std::string& text);
/// With so many decimals.
void appendFixed(double value, int decimals, std::string& text);
/// Returns numbers one behind the other, each with its low byte first.
template <class... Numbers>
[[nodiscard]] std::string lowBytes(Numbers... numbers) {
    std::string bytes;
    const auto append = [&bytes](const auto& raw) {
        std::endian::native == std::endian::little ? bytes.append(raw.begin(), raw.end())
                                                   : bytes.append(raw.rbegin(), raw.rend());
    };
    (append(std::bit_cast<std::array<char, sizeof(Numbers)>>(numbers)), ...);
    return bytes;
}

} // namespace posewire::exporting
