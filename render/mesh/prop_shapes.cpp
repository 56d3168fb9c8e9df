// SPDX-License-Identifier: MIT
#include "render/mesh/prop_shapes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace posewire::render {
namespace {

constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;
constexpr int kSides = 14;

/// Puts solids together; each has vertices of its own.
class Builder {
public:
    /// A round bar, as thick as said at its ends.
    void bar(const glm::vec3& from, const glm::vec3& to, float radiusFrom, float radiusTo) {
        const glm::vec3 along = glm::normalize(to - from);
        const glm::vec3 aside = glm::normalize(
            glm::cross(along, std::abs(along.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
        const glm::vec3 up = glm::cross(along, aside);
        const float lean = (radiusFrom - radiusTo) / glm::distance(from, to);
        const std::uint32_t first = next();
        for (int i = 0; i <= kSides; ++i) {
            const float angle = kTurn * static_cast<float>(i) / kSides;
            const glm::vec3 out = std::cos(angle) * aside + std::sin(angle) * up;
            const glm::vec3 normal = glm::normalize(out + lean * along);
            vertex(from + radiusFrom * out, normal);
            vertex(to + radiusTo * out, normal);
        }
        for (std::uint32_t i = first; i < first + 2 * kSides; i += 2) {
            triangle(i, i + 2, i + 1);
            triangle(i + 1, i + 2, i + 3);
        }
        disc(from, aside, up, radiusFrom, -along);
        disc(to, aside, up, radiusTo, along);
    }

    /// Along x between two rectangles of half their sizes in y and z.
    void block(float from, float to, const glm::vec2& halfFrom, const glm::vec2& halfTo,
               const glm::vec2& centre = {0.0F, 0.0F}) {
        const auto corner = [&](bool isFar, float y, float z) {
            const glm::vec2& half = isFar ? halfTo : halfFrom;
            return glm::vec3(isFar ? to : from, centre.x + y * half.x, centre.y + z * half.y);
        };
        constexpr std::array<glm::vec2, 4> kRound{{{1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
        for (std::size_t i = 0; i < kRound.size(); ++i) {
            const glm::vec2& a = kRound[i];
            const glm::vec2& b = kRound[(i + 1) % kRound.size()];
            face(corner(false, b.x, b.y), corner(true, b.x, b.y), corner(true, a.x, a.y),
                 corner(false, a.x, a.y));
        }
        face(corner(false, -1, -1), corner(false, -1, 1), corner(false, 1, 1), corner(false, 1, -1));
        face(corner(true, 1, -1), corner(true, 1, 1), corner(true, -1, 1), corner(true, -1, -1));
    }

    void ball(float radius) {
        constexpr int kRings = 12;
        const std::uint32_t first = next();
        for (int ring = 0; ring <= kRings; ++ring) {
            const float polar = 0.5F * kTurn * static_cast<float>(ring) / kRings;
            for (int i = 0; i <= kSides; ++i) {
                const float angle = kTurn * static_cast<float>(i) / kSides;
                const glm::vec3 out(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                                    std::cos(polar));
                vertex(radius * out, out);
            }
        }
        constexpr std::uint32_t kRow = kSides + 1;
        for (std::uint32_t ring = 0; ring < kRings; ++ring) {
            for (std::uint32_t i = 0; i < kSides; ++i) {
                const std::uint32_t at = first + ring * kRow + i;
                triangle(at, at + kRow, at + 1);
                triangle(at + 1, at + kRow, at + kRow + 1);
            }
        }
    }

    /// An ellipse of a round bar, flat in z.
    void hoop(const glm::vec3& centre, const glm::vec2& radii, float thickness) {
        constexpr int kParts = 24;
        const auto at = [&](int part) {
            const float angle = kTurn * static_cast<float>(part) / kParts;
            return centre + glm::vec3(radii.x * std::cos(angle), radii.y * std::sin(angle), 0.0F);
        };
        for (int part = 0; part < kParts; ++part) {
            bar(at(part), at(part + 1), thickness, thickness);
        }
    }

    SkinnedMesh take() { return std::move(m_mesh); }

private:
    [[nodiscard]] std::uint32_t next() const { return static_cast<std::uint32_t>(m_mesh.positions.size()); }
    void vertex(const glm::vec3& position, const glm::vec3& normal) {
        m_mesh.positions.push_back(position);
        m_mesh.normals.push_back(normal);
        m_mesh.occlusion.push_back(1.0F);
        m_mesh.joints.push_back({0, 0, 0, 0});
        m_mesh.weights.emplace_back(1.0F, 0.0F, 0.0F, 0.0F);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        m_mesh.indices.insert(m_mesh.indices.end(), {a, b, c});
    }
    /// Counter-clockwise seen from outside.
    void face(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
        const glm::vec3 normal = glm::normalize(glm::cross(c - a, d - b));
        const std::uint32_t first = next();
        for (const glm::vec3& corner : {a, b, c, d}) {
            vertex(corner, normal);
        }
        triangle(first, first + 1, first + 2);
        triangle(first, first + 2, first + 3);
    }
    void disc(const glm::vec3& centre, const glm::vec3& aside, const glm::vec3& up, float radius,
              const glm::vec3& normal) {
        const bool isTurned = glm::dot(glm::cross(aside, up), normal) < 0.0F;
        const std::uint32_t middle = next();
        vertex(centre, normal);
        for (int i = 0; i <= kSides; ++i) {
            const float angle = kTurn * static_cast<float>(i) / kSides;
            vertex(centre + radius * (std::cos(angle) * aside + std::sin(angle) * up), normal);
        }
        for (std::uint32_t i = middle + 1; i <= middle + kSides; ++i) {
            isTurned ? triangle(middle, i + 1, i) : triangle(middle, i, i + 1);
        }
    }

    SkinnedMesh m_mesh;
};

struct Word {
    std::string_view word;
    PropShape shape;
};
/// The first that is in a name decides.
constexpr std::array<Word, 27> kWords{{
    {"golf", PropShape::GolfClub}, {"sword", PropShape::Sword},   {"katana", PropShape::Sword},
    {"sabre", PropShape::Sword},   {"saber", PropShape::Sword},   {"blade", PropShape::Sword},
    {"knife", PropShape::Sword},   {"racket", PropShape::Racket}, {"racquet", PropShape::Racket},
    {"tennis", PropShape::Racket}, {"gun", PropShape::Gun},       {"rifle", PropShape::Gun},
    {"pistol", PropShape::Gun},    {"weapon", PropShape::Gun},    {"crutch", PropShape::Stick},
    {"stick", PropShape::Stick},   {"staff", PropShape::Stick},   {"cane", PropShape::Stick},
    {"pole", PropShape::Stick},    {"bat", PropShape::Stick},     {"spear", PropShape::Stick},
    {"club", PropShape::GolfClub}, {"ball", PropShape::Ball},     {"box", PropShape::Box},
    {"crate", PropShape::Box},     {"chair", PropShape::Box},     {"table", PropShape::Box},
}};

} // namespace

PropShape propShapeOf(std::string_view name) {
    std::string small(name);
    std::ranges::transform(small, small.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const auto found = std::ranges::find_if(
        kWords, [&](const Word& one) { return small.find(one.word) != std::string::npos; });
    return found == kWords.end() ? PropShape::Generic : found->shape;
}

SkinnedMesh propMesh(PropShape shape) {
    Builder builder;
    switch (shape) {
    case PropShape::Sword:
        builder.bar({-0.11F, 0, 0}, {0.08F, 0, 0}, 0.013F, 0.013F);
        builder.block(0.08F, 0.10F, {0.075F, 0.014F}, {0.075F, 0.014F});
        builder.block(0.10F, 0.78F, {0.021F, 0.005F}, {0.017F, 0.004F});
        builder.block(0.78F, 0.86F, {0.017F, 0.004F}, {0.001F, 0.001F});
        break;
    case PropShape::GolfClub:
        builder.bar({-0.14F, 0, 0}, {0.14F, 0, 0}, 0.013F, 0.012F);
        builder.bar({0.14F, 0, 0}, {0.94F, 0, 0}, 0.007F, 0.006F);
        builder.block(0.925F, 0.975F, {0.045F, 0.016F}, {0.045F, 0.022F}, {-0.04F, 0.0F});
        break;
    case PropShape::Stick:
        builder.bar({-0.45F, 0, 0}, {0.45F, 0, 0}, 0.014F, 0.014F);
        break;
    case PropShape::Racket:
        builder.bar({-0.10F, 0, 0}, {0.10F, 0, 0}, 0.016F, 0.015F);
        builder.bar({0.10F, 0, 0}, {0.27F, 0, 0}, 0.010F, 0.010F);
        builder.hoop({0.42F, 0, 0}, {0.16F, 0.125F}, 0.009F);
        for (const float across : {-0.06F, 0.0F, 0.06F}) {
            const float reach = 0.16F * std::sqrt(1.0F - across * across / (0.125F * 0.125F));
            builder.bar({0.42F - reach, across, 0}, {0.42F + reach, across, 0}, 0.002F, 0.002F);
        }
        break;
    case PropShape::Gun:
        builder.block(-0.06F, 0.24F, {0.014F, 0.024F}, {0.014F, 0.024F}, {0.0F, 0.045F});
        builder.bar({0.24F, 0, 0.052F}, {0.44F, 0, 0.052F}, 0.010F, 0.010F);
        builder.block(-0.02F, 0.03F, {0.013F, 0.05F}, {0.013F, 0.05F}, {0.0F, -0.02F});
        break;
    case PropShape::Ball:
        builder.ball(0.11F);
        break;
    case PropShape::Box:
        builder.block(-0.20F, 0.20F, {0.20F, 0.20F}, {0.20F, 0.20F});
        break;
    case PropShape::Generic:
        builder.block(-0.035F, 0.035F, {0.035F, 0.035F}, {0.035F, 0.035F});
        builder.bar({0.035F, 0, 0}, {0.10F, 0, 0}, 0.014F, 0.001F); // which way x is
        break;
    }
    return builder.take();
}

} // namespace posewire::render
