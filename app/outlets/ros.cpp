// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/outlets/ros.h"

#include "core/model/body/joint_angles.h"
#include "core/model/body/spaces.h"
#include "ros_messages.h"

#include <dds/dds.h>

#include <charconv>
#include <optional>
#include <span>
#include <vector>

namespace posewire::outlets {
namespace {

constexpr std::size_t kRosJoints = 22; // without the ergonomic angles, which are of no joint

/// A sequence of DDS over what a vector holds, for as long as that does not change.
template <class Sequence, class Item>
Sequence sequenceOf(std::vector<Item>& items) {
    const auto count = static_cast<std::uint32_t>(items.size());
    return {count, count, items.data(), false};
}

class RosWriter final : public PoseWriter {
public:
    /// Takes over the participant.
    RosWriter(const log::PacketLog& log, std::uint32_t domain, dds_entity_t participant)
        : m_log(log), m_domain(domain), m_participant(participant) {
        // As tf2's broadcaster and robot_state_publisher have them.
        m_transforms = writer(tf2_msgs_msg_dds__TFMessage__desc, "rt/tf", 100);
        m_joints = writer(sensor_msgs_msg_dds__JointState__desc, "rt/joint_states", 10);
    }
    ~RosWriter() override { dds_delete(m_participant); }
    RosWriter(const RosWriter&) = delete;
    RosWriter& operator=(const RosWriter&) = delete;

    [[nodiscard]] bool isGood() const { return m_transforms > 0 && m_joints > 0; }

    void take(const feed::PoseCharacter& character, const feed::PoseSample& sample) override {
        constexpr std::int64_t kSecond = 1'000'000'000;
        const std::int64_t nanoseconds = log::nanosecondsOf(m_log.timeline().wallOf(sample.pose.stamp));
        m_stamp = {static_cast<std::int32_t>(nanoseconds / kSecond),
                   static_cast<std::uint32_t>(nanoseconds % kSecond)};
        const std::string own = plainName(character.name.shown()) + '/';
        writeTransforms(own, sample.pose);
        if (!sample.pose.isObjects) {
            writeJoints(own, sample.pose);
        }
    }
    void tell(OutletState& state) const override {
        state.place = std::to_string(m_domain);
        for (const dds_entity_t writer : {m_transforms, m_joints}) {
            dds_publication_matched_status_t matched{};
            dds_get_publication_matched_status(writer, &matched);
            state.receivers = std::max<std::size_t>(state.receivers, matched.current_count);
        }
        state.sent = m_sent;
        state.skipped = m_skipped;
    }

private:
    dds_entity_t writer(const dds_topic_descriptor_t& type, const char* name, std::int32_t depth) const {
        dds_qos_t* qos = dds_create_qos();
        dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, 0); // waits for no receiver
        dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
        dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
        const dds_entity_t topic = dds_create_topic(m_participant, &type, name, qos, nullptr);
        const dds_entity_t made = dds_create_writer(m_participant, topic, qos, nullptr);
        dds_delete_qos(qos);
        return made;
    }

    void write(dds_entity_t writer, const void* message) {
        ++(dds_write(writer, message) == DDS_RETCODE_OK ? m_sent : m_skipped);
    }

    /// Each segment in the frame of its parent; the pelvis and what has none in that of the world.
    void writeTransforms(const std::string& own, const model::CharacterPose& pose) {
        using Transform = geometry_msgs_msg_dds__TransformStamped_;
        std::vector<std::string> names(pose.segments.size());
        std::vector<Transform> transforms;
        std::string world = "world";
        const auto isThere = [&](int place) {
            return place >= 0 && pose.isPresent(static_cast<std::size_t>(place));
        };
        for (std::size_t i = 0; i < names.size(); ++i) {
            names[i] = own + std::string(model::segmentName(pose.layout, static_cast<int>(i)));
        }
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (!pose.isPresent(i)) {
                continue;
            }
            int parent = model::segmentParent(pose.layout, static_cast<int>(i));
            while (parent >= 0 && !isThere(parent)) {
                parent = model::segmentParent(pose.layout, parent);
            }
            const auto above = static_cast<std::size_t>(parent);
            const model::SegmentPose local =
                parent < 0 ? pose.segments[i] : model::relativeTo(pose.segments[above], pose.segments[i]);
            const Eigen::Vector3d& at = local.position;
            const Eigen::Quaterniond& turn = local.orientation;
            transforms.push_back({{m_stamp, (parent < 0 ? world : names[above]).data()},
                                  names[i].data(),
                                  {{at.x(), at.y(), at.z()}, {turn.x(), turn.y(), turn.z(), turn.w()}}});
        }
        const tf2_msgs_msg_dds__TFMessage_ message{
            sequenceOf<decltype(tf2_msgs_msg_dds__TFMessage_::transforms)>(transforms)};
        write(m_transforms, &message);
    }

    /// Turns about x, y and z, one after the other, that lead from the parent of a joint to its child.
    void writeJoints(const std::string& own, const model::CharacterPose& pose) {
        std::vector<std::string> names;
        std::vector<double> positions;
        for (const model::JointDefinition& joint : std::span(model::jointDefinitions()).first(kRosJoints)) {
            const auto parent = static_cast<std::size_t>(joint.parentSegment());
            const auto child = static_cast<std::size_t>(joint.childSegment());
            if (!pose.isPresent(parent) || !pose.isPresent(child)) {
                continue;
            }
            const Eigen::Quaterniond turn =
                pose.segments[parent].orientation.conjugate() * pose.segments[child].orientation;
            const Eigen::Vector3d back = model::eulerFromQuaternion(turn.conjugate());
            for (std::size_t axis = 0; axis < 3; ++axis) {
                names.push_back(own + std::string(joint.name) + "_rot" + "xyz"[axis]);
                positions.push_back(-back[static_cast<Eigen::Index>(axis)]);
            }
        }
        std::vector<char*> texts;
        for (std::string& name : names) {
            texts.push_back(name.data());
        }
        sensor_msgs_msg_dds__JointState_ message{};
        std::string world = "world";
        message.header = {m_stamp, world.data()};
        message.name = sequenceOf<decltype(message.name)>(texts);
        message.position = sequenceOf<decltype(message.position)>(positions);
        write(m_joints, &message);
    }

    const log::PacketLog& m_log;
    std::uint32_t m_domain;
    dds_entity_t m_participant;
    dds_entity_t m_transforms = 0;
    dds_entity_t m_joints = 0;
    builtin_interfaces_msg_dds__Time_ m_stamp{};
    std::uint64_t m_sent = 0;
    std::uint64_t m_skipped = 0;
};

/// The domain that is typed; nothing if it is none.
std::optional<std::uint32_t> domainOf(const std::string& text) {
    constexpr std::uint32_t kMost = 232;
    std::uint32_t domain = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
    const bool isOne = error == std::errc() && end == text.data() + text.size() && domain <= kMost;
    return isOne ? std::optional(domain) : std::nullopt;
}

} // namespace

MakeWriter rosIn(const OutletChoice& choice) {
    return [choice](const log::PacketLog& log) -> net::NetResult<std::unique_ptr<PoseWriter>> {
        const auto domain = domainOf(choice.place);
        if (!domain) {
            return net::netError(net::NetError::Kind::BadEndpoint,
                                 choice.place + " is no domain of ROS; write a number from 0 to 232");
        }
        const dds_entity_t participant = dds_create_participant(*domain, nullptr, nullptr);
        auto writer = participant > 0 ? std::make_unique<RosWriter>(log, *domain, participant) : nullptr;
        if (writer == nullptr || !writer->isGood()) {
            return net::netError(net::NetError::Kind::Other, "DDS does not start in domain " + choice.place +
                                                                 "; is CYCLONEDDS_URI right?");
        }
        return writer;
    };
}

} // namespace posewire::outlets
