// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"

#include "core/export/motion/skeleton.h"

#include <algorithm>
#include <cmath>

namespace posewire::exporting {
namespace {

using Eigen::Vector3d;

constexpr double kCentimetres = 100;

void appendVector(const Vector3d& vector, std::string& text) {
    for (const double value : {vector.x(), vector.y(), vector.z()}) {
        text += ' ';
        appendFixed(value, 6, text);
    }
}

/// Angles about Z, X and Y in degrees, of R = Rz·Rx·Ry. Where x is upright, y is 0.
Vector3d anglesZxy(const Eigen::Quaterniond& turn) {
    const Eigen::Matrix3d r = turn.toRotationMatrix();
    const double x = std::asin(std::clamp(r(2, 1), -1.0, 1.0));
    const bool isUpright = std::hypot(r(2, 0), r(2, 2)) < 1e-9;
    const double z = isUpright ? std::atan2(r(1, 0), r(0, 0)) : std::atan2(-r(0, 1), r(1, 1));
    const double y = isUpright ? 0 : std::atan2(-r(2, 0), r(2, 2));
    return Vector3d(z, x, y) * model::kDegreesPerRadian;
}

class BvhWriter final : public MotionWriter {
public:
    explicit BvhWriter(const MotionTask& task)
        : m_character(task.characterAt(task.characters.front())),
          m_survey(task.surveyAt(task.characters.front())),
          m_skeleton(skeletonOf(m_character, m_survey, false)),
          m_motion(m_skeleton) {}

    void begin(MotionOutput& out) override {
        std::string text = "HIERARCHY\n";
        if (!m_skeleton.joints.empty()) {
            addJoint(0, 0, text);
        }
        text += "MOTION\nFrames: " + std::to_string(m_survey.frames) + "\nFrame Time: ";
        appendFixed(1 / m_survey.writtenRateHz(), 8, text);
        out.write(text + '\n');
    }

    void add(const MotionFrame& frame, MotionOutput& out) override {
        if (!frame.isGap()) {
            m_motion.set(*frame.pose);
            makeLine();
        }
        out.write(m_line);
    }

private:
    void addJoint(std::size_t place, std::size_t depth, std::string& text) const {
        const SkeletonJoint& joint = m_skeleton.joints[place];
        const std::string indent(depth, '\t');
        const bool isRoot = joint.parent < 0;
        text += indent + (isRoot ? "ROOT " : "JOINT ") + std::string(joint.name) + '\n' + indent + "{\n";
        text += indent + "\tOFFSET";
        appendVector(isRoot ? Vector3d(0, 0, 0) : Vector3d(kCentimetres * model::yUpFromZUp(joint.offset)),
                     text);
        text += '\n' + indent +
                (isRoot ? "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                        : "\tCHANNELS 3 Zrotation Xrotation Yrotation\n");
        for (const std::size_t child : joint.children) {
            addJoint(child, depth + 1, text);
        }
        if (joint.children.empty()) {
            text += indent + "\tEnd Site\n" + indent + "\t{\n" + indent + "\t\tOFFSET";
            appendVector(kCentimetres * model::yUpFromZUp(endOf(joint, m_character)), text);
            text += '\n' + indent + "\t}\n";
        }
        text += indent + "}\n";
    }

    void makeLine() {
        m_line.clear();
        const std::vector<model::SegmentPose>& local = m_motion.local();
        for (std::size_t i = 0; i < local.size() && (i == 0 || m_skeleton.joints[i].parent >= 0); ++i) {
            if (i == 0) {
                appendVector(kCentimetres * model::yUpFromZUp(local[i].position), m_line);
            }
            appendVector(anglesZxy(model::yUpFromZUp(local[i].orientation)), m_line);
        }
        m_line.erase(0, 1);
        m_line += '\n';
    }

    const feed::PoseCharacter& m_character;
    const CharacterSurvey& m_survey;
    Skeleton m_skeleton;
    JointMotion m_motion;
    std::string m_line;
};

} // namespace

std::unique_ptr<MotionWriter> makeBvh(const MotionTask& task) {
    return std::make_unique<BvhWriter>(task);
}

} // namespace posewire::exporting
