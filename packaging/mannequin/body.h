// SPDX-License-Identifier: MIT
#pragma once

#include "packaging/mannequin/body_tables.h"

#include <optional>
#include <vector>

namespace posewire::render::mannequin {

/// The body as one signed field, symmetric in y, in the frame of body_tables.h.
/// The value is right where the surface is within 0.1 m, elsewhere only its sign is.
class Body {
public:
    Body();

    double distance(const glm::dvec3& point) const;
    /// Central differences over ±step.
    glm::dvec3 gradient(const glm::dvec3& point, double step) const;

private:
    struct Addition {
        std::variant<EllipsoidField, Cone> shape;
        double radius;
        Blend::Kind kind;
    };

    struct Finger {
        std::array<Cone, 3> bones;
        /// Blend with the hand.
        double blend;
    };

    struct Part {
        std::optional<LoftField> loft;
        std::vector<Addition> additions;
        std::vector<Finger> fingers;
        /// Blend with the parts before.
        double blend = 0.0;
        bool hasSole = false;
        Box bounds{};
    };

    static Part makePart(double blend, const LoftShape* loft, std::span<const Blend> blends);
    static void addHand(Part& part);
    static double partDistance(const Part& part, const glm::dvec3& point);

    std::vector<Part> m_parts;
};

} // namespace posewire::render::mannequin
