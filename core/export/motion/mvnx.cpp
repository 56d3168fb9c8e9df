// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"

#include "core/model/body/joint_angles.h"
#include "core/model/body/points.h"
#include "core/model/text.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <span>

namespace posewire::exporting {
namespace {

constexpr std::size_t kBody = model::kBodySegmentCount;
/// Without the ergonomic angles: what their vertical is, is not published.
constexpr std::size_t kJoints = 22;

/// For text and for attributes.
std::string xmlText(const model::ForeignText& text) {
    std::string safe = text.html();
    for (const std::string_view forbidden : {"\xef\xbf\xbe", "\xef\xbf\xbf"}) { // U+FFFE and U+FFFF
        for (auto at = safe.find(forbidden); at != std::string::npos; at = safe.find(forbidden, at)) {
            safe.replace(at, forbidden.size(), "\xef\xbf\xbd");
        }
    }
    return safe;
}

/// "Thu Nov 27 12:13:17.238 2025", UTC.
std::string dateText(log::WallTime time) {
    using namespace std::chrono;
    constexpr std::array<const char*, 7> weekdays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    constexpr std::array<const char*, 12> months{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                 "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    const auto day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(floor<milliseconds>(time - day));
    return std::string(weekdays[weekday(day).c_encoding()]) + ' ' +
           months[static_cast<unsigned>(date.month()) - 1] + ' ' +
           model::padded(static_cast<unsigned>(date.day()), 2) + ' ' +
           model::padded(clock.hours().count(), 2) + ':' + model::padded(clock.minutes().count(), 2) + ':' +
           model::padded(clock.seconds().count(), 2) + '.' + model::padded(clock.subseconds().count(), 3) +
           ' ' + std::to_string(static_cast<int>(date.year()));
}

std::int64_t millisecondsOf(log::WallTime time) {
    return std::chrono::floor<std::chrono::milliseconds>(time).time_since_epoch().count();
}

void appendAll(std::initializer_list<double> values, std::string& text) {
    for (const double value : values) {
        text += text.ends_with('>') ? "" : " ";
        appendFixed(value, 6, text);
    }
}

void appendNumbers(const Eigen::Vector3d& vector, std::string& text) {
    appendAll({vector.x(), vector.y(), vector.z()}, text);
}

class MvnxWriter final : public MotionWriter {
public:
    explicit MvnxWriter(const MotionTask& task)
        : m_task(task),
          m_character(task.characterAt(task.characters.front())),
          m_survey(task.surveyAt(task.characters.front())) {}

    void begin(MotionOutput& out) override {
        const model::ForeignText application(m_task.application);
        std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                           "<mvnx version=\"4\" xmlns=\"http://www.xsens.com/mvn/mvnx\">\n<mvn version=\"" +
                           xmlText(application) + "\" build=\"" + xmlText(application) + "\"/>\n" +
                           "<comment>Recorded from a network stream by " + xmlText(application) +
                           ": without sensors, velocities, contacts, props and fingers</comment>\n";
        std::string rate;
        appendNumber(m_survey.writtenRateHz(), rate);
        text += "<subject label=\"" + xmlText(m_character.name) + "\" torsoColor=\"" +
                model::colourText(m_character.colour) + "\" frameRate=\"" + rate + "\" segmentCount=\"" +
                std::to_string(kBody) + '"' + dateAttributes() +
                " originalFilename=\"network stream\" configuration=\"" + configuration() +
                "\" userScenario=\"singleLevel\">\n<comment>" + provenanceText() + "</comment>\n";
        addSegments(text);
        addJoints(text);
        text += "<frames segmentCount=\"" + std::to_string(kBody) + "\" jointCount=\"" +
                std::to_string(kJoints) + "\">\n";
        addNullPoses(text);
        out.write(text);
    }

    void add(const MotionFrame& frame, MotionOutput& out) override {
        const std::uint64_t index = m_index++;
        if (frame.isGap() || !hasBody(*frame.pose)) {
            return;
        }
        const auto receipt = m_task.receiptOf(frame);
        std::string text =
            "<frame time=\"" + std::to_string(static_cast<std::int64_t>(frame.seconds * 1000 + 0.5)) +
            "\" index=\"" + std::to_string(index) + "\" tc=\"" +
            timeCodeText(frame.timeOfDay ? static_cast<std::uint32_t>(frame.timeOfDay->milliseconds())
                                         : frame.pose->timeCode) +
            '"' + (receipt ? " ms=\"" + std::to_string(millisecondsOf(*receipt)) + '"' : std::string()) +
            " type=\"normal\">\n";
        std::array<Eigen::Quaterniond, kBody> turns;
        text += "<orientation>";
        for (std::size_t i = 0; i < kBody; ++i) {
            turns[i] = frame.pose->segments[i].orientation;
            appendAll({turns[i].w(), turns[i].x(), turns[i].y(), turns[i].z()}, text);
        }
        text += "</orientation>\n<position>";
        for (std::size_t i = 0; i < kBody; ++i) {
            appendNumbers(frame.pose->segments[i].position, text);
        }
        std::array<Eigen::Vector3d, kJoints> angles;
        model::jointAngles(turns, angles, model::stanceOf(m_character.body().places));
        text += "</position>\n<jointAngle>";
        for (const Eigen::Vector3d& angle : angles) {
            appendNumbers(angle * model::kDegreesPerRadian, text);
        }
        out.write(text + "</jointAngle>\n</frame>\n");
    }

    void finish(MotionOutput& out) override {
        // The code by which MVN knows its own files is not ours to make.
        out.write("</frames>\n</subject>\n<securityCode code=\"none\"/>\n</mvnx>\n");
    }

private:
    static bool hasBody(const model::CharacterPose& pose) {
        const auto isMissing = [](const model::SegmentSource& source) {
            return source.position == model::Provenance::None;
        };
        return pose.layout.body >= model::kBodySegmentCount && pose.sources.size() >= kBody &&
               std::none_of(pose.sources.begin(), pose.sources.begin() + kBody, isMissing);
    }

    /// With a blank before them; none where nothing tells the date.
    [[nodiscard]] std::string dateAttributes() const {
        const log::WallTime start = m_task.source.log->timeline().wallOf(m_survey.first);
        return m_character.hasReceipt ? " recDate=\"" + dateText(start) + "\" recDateMSecsSinceEpoch=\"" +
                                            std::to_string(millisecondsOf(start)) + '"'
                                      : std::string();
    }

    void addSegments(std::string& text) const {
        text += "<segments>\n";
        for (const model::Segment& segment : model::bodySegments()) {
            text += "<segment label=\"" + std::string(segment.name) + "\" id=\"" +
                    std::to_string(segment.id) + "\">\n<points>\n";
            addPoints(segment.id, text);
            text += "</points>\n</segment>\n";
        }
        text += "</segments>\n";
    }

    /// Of a segment without points, or without a null pose: its origin, which readers want to find.
    void addPoints(int segment, std::string& text) const {
        const std::size_t before = text.size();
        const auto add = [&text](const std::string& label, const Eigen::Vector3d& place) {
            text += "<point label=\"" + label + "\"><pos_b>";
            appendNumbers(place, text);
            text += "</pos_b></point>\n";
        };
        if (m_character.nullPose) {
            for (const model::NullPose::Point& point : m_character.nullPose->points) {
                if (point.segment == segment && point.position.allFinite()) {
                    add(labelOf(point), point.position);
                }
            }
        }
        const model::AnatomicalPoint* origin = model::findPoint(segment - 1, 1);
        if (text.size() == before && origin != nullptr) {
            add(std::string(origin->name), Eigen::Vector3d::Zero());
        }
    }

    /// Letters and digits alone, as MVNX wants labels; "P269" if there are none.
    static std::string labelOf(const model::NullPose::Point& point) {
        std::string label;
        for (const char character : point.name.exact()) {
            const bool isKept = (character >= '0' && character <= '9') ||
                                (character >= 'a' && character <= 'z') ||
                                (character >= 'A' && character <= 'Z');
            label += isKept ? std::string(1, character) : std::string();
        }
        return label.empty() ? "P" + std::to_string(256 * point.segment + point.id) : label;
    }

    static void addJoints(std::string& text) {
        const auto connector = [](const model::PointReference& reference) {
            const auto segment = static_cast<std::size_t>(reference.segmentId - 1);
            const model::AnatomicalPoint* point =
                model::findPoint(reference.segmentId - 1, reference.localId);
            return std::string(model::bodySegments()[segment].name) + '/' +
                   std::string(point != nullptr ? point->name : "");
        };
        text += "<joints>\n";
        for (const model::JointDefinition& joint : std::span(model::jointDefinitions()).first<kJoints>()) {
            text += "<joint label=\"" + std::string(joint.name) + "\"><connector1>" +
                    connector(joint.parent) + "</connector1><connector2>" + connector(joint.child) +
                    "</connector2></joint>\n";
        }
        text += "</joints>\n";
    }

    /// Writes the pose that readers need before the first frame three times, as MVN does: the null pose of
    /// type 13, or the body used instead, with no segment turned. MVN's own `tpose` is the calibration pose,
    /// which is not sent. In `tpose-isb` arms have their ISB frames.
    void addNullPoses(std::string& text) const {
        int index = -3;
        for (const std::string_view type : {"identity", "tpose", "tpose-isb"}) {
            text += "<frame time=\"0\" index=\"" + std::to_string(index++) + "\" tc=\"" + timeCodeText(0) +
                    "\" ms=\"0\" type=\"" + std::string(type) + "\">\n<orientation>";
            for (int i = 0; i < model::kBodySegmentCount; ++i) {
                const Eigen::Quaterniond turn =
                    type == "tpose-isb" ? model::isbFrame(i) : Eigen::Quaterniond::Identity();
                appendAll({turn.w(), turn.x(), turn.y(), turn.z()}, text);
            }
            text += "</orientation>\n<position>";
            for (const Eigen::Vector3d& place : m_character.body().places) {
                appendNumbers(place, text);
            }
            text += "</position>\n</frame>\n";
        }
    }

    /// UpperBody if the pelvis of the first sample is at the origin, where MVN keeps it without trackers on
    /// the legs, and the feet hang below the floor. No stream tells LowerBody.
    [[nodiscard]] std::string configuration() const {
        constexpr double kNear = 0.02;    // metres
        constexpr double kHanging = -0.5; // where MVN has feet: about -0.79
        const auto& segments = m_survey.firstPose.segments;
        const bool isUpper = segments.size() >= kBody && segments[0].position.norm() < kNear &&
                             segments[model::segment::kRightFoot].position.z() < kHanging;
        return isUpper ? "UpperBody" : "FullBody";
    }

    [[nodiscard]] std::string provenanceText() const {
        std::array<int, 4> counts{};
        for (const model::SegmentSource& source : m_survey.firstPose.sources) {
            ++counts[std::min<std::size_t>(static_cast<std::size_t>(source.position), 3)];
        }
        const int sent = counts[static_cast<std::size_t>(model::Provenance::Sent)];
        return "Null pose " + std::string(m_character.nullPose ? "as sent" : "assumed") + "; " +
               std::to_string(sent) + " segments of the first sample with positions as sent, others computed";
    }

    /// HH:MM:SS and the frame in the second, with three digits from 100 Hz on, as MVN writes it.
    [[nodiscard]] std::string timeCodeText(std::uint32_t ms) const {
        const double rate = m_survey.writtenRateHz();
        const auto frame = static_cast<std::int64_t>(ms % 1000 * rate / 1000 + 1e-6);
        return model::padded(ms / 3'600'000 % 24, 2) + ':' + model::padded(ms / 60'000 % 60, 2) + ':' +
               model::padded(ms / 1000 % 60, 2) + ':' + model::padded(frame, rate > 100 ? 3 : 2);
    }

    const MotionTask& m_task;
    const feed::PoseCharacter& m_character;
    const CharacterSurvey& m_survey;
    std::uint64_t m_index = 0;
};

} // namespace

std::unique_ptr<MotionWriter> makeMvnx(const MotionTask& task) {
    return std::make_unique<MvnxWriter>(task);
}

} // namespace posewire::exporting
