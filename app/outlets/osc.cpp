// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/osc.h"

#include "app/outlets/osc_sender.h"
#include "core/model/body/spaces.h"
#include "core/wire/type_table.h"

#include <utility>
#include <vector>

namespace posewire::outlets {
namespace {

class OscWriter : public PoseWriter {
public:
    OscWriter(const log::PacketLog& log, OscSender sender) : m_log(log), m_sender(std::move(sender)) {}

    void take(const feed::PoseCharacter& character, const feed::PoseSample& sample) override {
        m_sender.begin(m_log.timeline().wallOf(sample.pose.stamp));
        write(character, sample.pose);
        m_sender.finish();
    }
    void tell(OutletState& state) const override {
        state.place = m_sender.place();
        state.receivers = 1;
        state.sent = m_sender.sent();
        state.refused = m_sender.refused();
    }

protected:
    virtual void write(const feed::PoseCharacter& character, const model::CharacterPose& pose) = 0;

    const log::PacketLog& m_log;
    OscSender m_sender;
};

class AllSegments final : public OscWriter {
public:
    using OscWriter::OscWriter;

private:
    void write(const feed::PoseCharacter& character, const model::CharacterPose& pose) override {
        const std::string own = "/posewire/" + plainName(character.name.shown());
        const auto sender = m_log.senders().find(character.key.sender);
        m_sender.add(own + "/pose",
                     {std::int32_t{character.key.character}, static_cast<std::int32_t>(pose.sample),
                      static_cast<std::int32_t>(pose.timeCode), std::string(wire::typeDigits(pose.type)),
                      sender != nullptr ? sender->address : std::string()});
        for (std::size_t i = 0; i < pose.segments.size(); ++i) {
            const std::string_view name = model::segmentName(pose.layout, static_cast<int>(i));
            if (pose.isPresent(i) && !name.empty()) {
                const auto [x, y, z] = model::toFloats(pose.segments[i].position);
                const auto [qw, qx, qy, qz] = model::toFloats(pose.segments[i].orientation);
                m_sender.add(own + "/segment/" + std::string(name), {x, y, z, qw, qx, qy, qz});
            }
        }
    }
};

/// A bone of VRM, which Unity calls humanoid, and the segment that turns it.
struct Bone {
    std::string name;
    model::SegmentPlace place;
    int parent = -1; ///< before it in the list
};

/// Joints of the spine that VRM lacks are in those above them; what VRM calls the proximal bone of the thumb
/// is its metacarpal.
std::vector<Bone> makeBones() {
    using namespace model::segment;
    using enum model::SegmentKind;
    std::vector<Bone> bones{{"Hips", {Body, kPelvis}},  {"Spine", {Body, kL3}, 0},
                            {"Chest", {Body, kT12}, 1}, {"UpperChest", {Body, kT8}, 2},
                            {"Neck", {Body, kNeck}, 3}, {"Head", {Body, kHead}, 4}};
    const auto addChain = [&bones](int parent, std::initializer_list<Bone> chain) {
        for (Bone bone : chain) {
            bone.parent = std::exchange(parent, static_cast<int>(bones.size()));
            bones.push_back(std::move(bone));
        }
        return parent;
    };
    const auto addSide = [&](const std::string& side, int shoulder, int thigh, model::SegmentKind fingers) {
        const int hand = addChain(3, {{side + "Shoulder", {Body, shoulder}},
                                      {side + "UpperArm", {Body, shoulder + 1}},
                                      {side + "LowerArm", {Body, shoulder + 2}},
                                      {side + "Hand", {Body, shoulder + 3}}});
        addChain(0, {{side + "UpperLeg", {Body, thigh}},
                     {side + "LowerLeg", {Body, thigh + 1}},
                     {side + "Foot", {Body, thigh + 2}},
                     {side + "Toes", {Body, thigh + 3}}});
        int first = 1; // after the carpus; the other fingers have a metacarpal before
        for (const char* finger : {"Thumb", "Index", "Middle", "Ring", "Little"}) {
            const std::string name = side + finger;
            addChain(hand, {{name + "Proximal", {fingers, first}},
                            {name + "Intermediate", {fingers, first + 1}},
                            {name + "Distal", {fingers, first + 2}}});
            first += 4;
        }
    };
    addSide("Left", kLeftShoulder, kLeftUpperLeg, LeftFinger);
    addSide("Right", kRightShoulder, kRightUpperLeg, RightFinger);
    return bones;
}

class VmcBones final : public OscWriter {
public:
    VmcBones(const log::PacketLog& log, OscSender sender, std::string wanted)
        : OscWriter(log, std::move(sender)), m_wanted(std::move(wanted)) {}

    void take(const feed::PoseCharacter& character, const feed::PoseSample& sample) override {
        const bool isWanted = m_wanted.empty() ? sample.character == 0
                                               : character.name.shown() == m_wanted ||
                                                     std::to_string(character.key.character) == m_wanted;
        if (isWanted && !sample.pose.isObjects) {
            OscWriter::take(character, sample);
        }
    }

private:
    void write(const feed::PoseCharacter& /*character*/, const model::CharacterPose& pose) override {
        static const std::vector<Bone> kBones = makeBones();
        m_begin = m_begin.value_or(pose.stamp);
        m_sender.add("/VMC/Ext/OK", {1, 3, 0, 1}); // loaded; calibrated, in the usual way; tracked
        m_sender.add("/VMC/Ext/T", {static_cast<float>(log::secondsOf(pose.stamp - *m_begin))});
        m_sender.add("/VMC/Ext/Root/Pos", {std::string("root"), 0.F, 0.F, 0.F, 0.F, 0.F, 0.F, 1.F});
        const auto placeOf = [&](int bone) {
            return model::positionIn(pose.layout, kBones[static_cast<std::size_t>(bone)].place);
        };
        const auto isThere = [&](int bone) {
            const int place = placeOf(bone);
            return place >= 0 && pose.isPresent(static_cast<std::size_t>(place));
        };
        for (int i = 0; i < static_cast<int>(kBones.size()); ++i) {
            const Bone& bone = kBones[static_cast<std::size_t>(i)];
            if (!isThere(i)) {
                continue;
            }
            int parent = bone.parent;
            while (parent >= 0 && !isThere(parent)) { // which stays as it is in the T-pose
                parent = kBones[static_cast<std::size_t>(parent)].parent;
            }
            const model::SegmentPose& world = pose.segments[static_cast<std::size_t>(placeOf(i))];
            const model::SegmentPose own =
                parent < 0
                    ? world
                    : model::relativeTo(pose.segments[static_cast<std::size_t>(placeOf(parent))], world);
            const auto [x, y, z] = model::toFloats(model::unityFromZUp(own.position));
            const auto [qw, qx, qy, qz] = model::toFloats(model::unityFromZUp(own.orientation));
            m_sender.add("/VMC/Ext/Bone/Pos", {bone.name, x, y, z, qx, qy, qz, qw});
        }
        m_sender.add("/VMC/Ext/Blend/Val", {std::string("Neutral"), 1.F}); // MVN captures no face
        m_sender.add("/VMC/Ext/Blend/Apply", {});
    }

    std::string m_wanted;
    std::optional<log::Stamp> m_begin;
};

template <class Writer, class... More>
net::NetResult<std::unique_ptr<PoseWriter>> make(const std::string& place, const log::PacketLog& log,
                                                 const More&... more) {
    auto sender = OscSender::connect(place);
    if (!sender) {
        return tl::unexpected(std::move(sender.error()));
    }
    return std::make_unique<Writer>(log, std::move(*sender), more...);
}

} // namespace

MakeWriter oscTo(const OutletChoice& choice) {
    return [choice](const log::PacketLog& log) { return make<AllSegments>(choice.place, log); };
}

MakeWriter vmcTo(const OutletChoice& choice) {
    return
        [choice](const log::PacketLog& log) { return make<VmcBones>(choice.place, log, choice.character); };
}

} // namespace posewire::outlets
