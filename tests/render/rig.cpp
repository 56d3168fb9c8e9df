// SPDX-License-Identifier: MIT
#include "tests/render/rig.h"

#include <map>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace posewire::render::test {
namespace {

constexpr int kSides = 10;

struct Joint {
    std::string name;
    int parent;
    glm::vec3 place;
    float radius; ///< of the tube to its first child
};

class Builder {
public:
    explicit Builder(const Rig& rig) : m_rig(rig) {
        const int hips = add("Hips", -1, {0, 0, 0.96F}, 0.12F);
        const int spine = add("Spine", hips, {-0.01F, 0, 1.06F}, 0.12F);
        const int spine1 = add("Spine1", spine, {-0.015F, 0, 1.18F}, 0.125F);
        const int spine2 = add("Spine2", spine1, {-0.01F, 0, 1.30F}, 0.13F);
        const int neck = add("Neck", spine2, {0, 0, 1.48F}, 0.05F);
        const int head = add("Head", neck, {0.01F, 0, 1.57F}, 0.09F);
        add("HeadTop_End", head, {0.01F, 0, 1.75F}, 0.0F);
        for (const float side : {1.0F, -1.0F}) {
            addArm(spine2, side);
            addLeg(hips, side);
        }
    }

    ImportedCharacter run() {
        ImportedCharacter character;
        for (const Joint& joint : m_joints) {
            const glm::vec3 place = m_rig.fileUnit * (m_rig.fileTurn * joint.place);
            character.bones.push_back({"mixamorig:" + joint.name, joint.parent, place, m_rig.fileTurn, true});
        }
        for (std::size_t i = 0; i < m_joints.size(); ++i) {
            for (const Joint& child : m_joints) {
                if (child.parent == static_cast<int>(i) && m_joints[i].radius > 0.0F) {
                    addTube(character, static_cast<int>(i), child.place);
                }
            }
        }
        character.parts.push_back({0, static_cast<std::uint32_t>(character.mesh.indices.size())});
        return character;
    }

private:
    int add(const std::string& name, int parent, const glm::vec3& place, float radius) {
        m_joints.push_back({name, parent, place, radius});
        return static_cast<int>(m_joints.size()) - 1;
    }

    void addArm(int spine, float side) {
        const std::string name = side > 0.0F ? "Left" : "Right";
        const glm::vec3 mirror(1, side, 1);
        const glm::quat down = glm::angleAxis(-side * glm::radians(m_rig.armsDown), glm::vec3(1, 0, 0));
        const glm::vec3 shoulder = mirror * glm::vec3(-0.01F, 0.17F, 1.43F);
        const auto along = [&](float length) { return shoulder + down * glm::vec3(0, side * length, 0); };
        const int clavicle = add(name + "Shoulder", spine, mirror * glm::vec3(-0.01F, 0.04F, 1.40F), 0.06F);
        const int upper = add(name + "Arm", clavicle, shoulder, 0.05F);
        const int fore = add(name + "ForeArm", upper, along(0.27F), 0.042F);
        const int hand = add(name + "Hand", fore, along(0.50F), 0.038F);
        const glm::quat palm = down * glm::angleAxis(-glm::radians(m_rig.palmsAhead), glm::vec3(0, side, 0));
        const auto inHand = [&](const glm::vec3& at) { return along(0.50F) + palm * (mirror * at); };
        glm::vec3 place(0.033F, 0.087F, -0.002F);
        glm::quat bend(1, 0, 0, 0);
        int parent = hand;
        for (int i = 1; i <= 3; ++i) {
            parent = add(name + "HandIndex" + std::to_string(i), parent, inHand(place), 0.012F);
            bend = bend * glm::angleAxis(-glm::radians(m_rig.fingersBent), glm::vec3(1, 0, 0));
            place += bend * glm::vec3(0.005F, 0.034F, -0.002F);
        }
        add(name + "HandIndex4", parent, inHand(place), 0.0F);
        const int little = add(name + "HandPinky1", hand, inHand({-0.030F, 0.078F, -0.002F}), 0.010F);
        add(name + "HandPinky2", little, inHand({-0.036F, 0.110F, -0.004F}), 0.0F);
    }

    void addLeg(int hips, float side) {
        const std::string name = side > 0.0F ? "Left" : "Right";
        const glm::quat apart = glm::angleAxis(side * glm::radians(m_rig.legsApart), glm::vec3(1, 0, 0));
        const glm::vec3 hip(0.0F, side * 0.09F, 0.93F);
        const auto down = [&](float length) { return hip + m_rig.legs * (apart * glm::vec3(0, 0, -length)); };
        const int upper = add(name + "UpLeg", hips, hip, 0.075F);
        const int lower = add(name + "Leg", upper, down(0.43F), 0.055F);
        const int foot = add(name + "Foot", lower, down(0.85F), 0.04F);
        const glm::quat out = glm::angleAxis(side * glm::radians(m_rig.feetOut), glm::vec3(0, 0, 1));
        const int toe =
            add(name + "ToeBase", foot, down(0.85F) + out * glm::vec3(0.13F, 0.0F, -0.045F), 0.035F);
        add(name + "Toe_End", toe, down(0.85F) + out * glm::vec3(0.20F, 0.0F, -0.045F), 0.0F);
    }

    void addTube(ImportedCharacter& character, int bone, const glm::vec3& to) const {
        const Joint& joint = m_joints[static_cast<std::size_t>(bone)];
        const glm::vec3 axis = glm::normalize(to - joint.place);
        const glm::vec3 aside = glm::normalize(
            glm::cross(axis, std::abs(axis.x) < 0.7F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
        const glm::vec3 other = glm::cross(axis, aside);
        SkinnedMesh& mesh = character.mesh;
        const auto first = static_cast<std::uint32_t>(mesh.vertexCount());
        const auto vertex = [&](const glm::vec3& place, const glm::vec3& normal, const glm::vec2& uv) {
            mesh.positions.push_back(m_rig.fileUnit * (m_rig.fileTurn * place));
            mesh.normals.push_back(m_rig.fileTurn * normal);
            mesh.occlusion.push_back(1.0F);
            mesh.joints.push_back({static_cast<std::uint8_t>(bone), 0, 0, 0});
            mesh.weights.emplace_back(1, 0, 0, 0);
            character.texturePlaces.push_back(uv);
        };
        for (int i = 0; i <= kSides; ++i) {
            const float part = static_cast<float>(i) / kSides;
            const float angle = 2.0F * std::numbers::pi_v<float> * part;
            const glm::vec3 out = std::cos(angle) * aside + std::sin(angle) * other;
            vertex(joint.place + joint.radius * out, out, {part, 0.0F});
            vertex(to + 0.85F * joint.radius * out, out, {part, 1.0F});
        }
        vertex(joint.place - 0.3F * joint.radius * axis, -axis, {0.0F, 0.0F});
        vertex(to + 0.3F * joint.radius * axis, axis, {0.0F, 1.0F});
        const std::uint32_t begin = first + 2 * (kSides + 1);
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t at = first + 2 * i;
            for (const std::uint32_t index :
                 {at, at + 2, at + 1, at + 1, at + 2, at + 3, begin, at + 2, at, begin + 1, at + 1, at + 3}) {
                mesh.indices.push_back(index);
            }
        }
    }

    const Rig& m_rig;
    std::vector<Joint> m_joints;
};

} // namespace

ImportedCharacter Rig::character() const {
    return Builder(*this).run();
}

glm::vec3 placeOf(const OwnBody& body, std::span<const DualQuaternion> palette, Segment segment,
                  float scale) {
    const auto joint = static_cast<std::size_t>(body.segmentJoints[segment]);
    return transformPoint(palette[joint], scale * body.joints[joint].origin);
}

} // namespace posewire::render::test
