// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/units.h"
#include "core/wire/codec.h"
#include "core/words/fact.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace posewire::model {

enum class Revision : std::uint8_t { Unknown, E, JOrK, N };
[[nodiscard]] words::Kind revisionName(Revision revision);

/// "metres", "centimetres".
[[nodiscard]] words::Kind unitName(LengthUnit unit);
/// "Z-up", "Y-up".
[[nodiscard]] words::Kind upName(UpAxis up);
/// As it is given to programs, "y" or "z"; nothing for others.
[[nodiscard]] std::optional<UpAxis> upNamed(std::string_view name);

struct Detection {
    Revision revision = Revision::Unknown;
    words::Fact revisionEvidence;                ///< "counts in its header"
    LengthUnit positionUnit = LengthUnit::Metre; ///< of types 02, 05, 21 and 24
    LengthUnit yUpUnit = LengthUnit::Centimetre; ///< of types 01, 03 and 04
    words::Fact unitEvidence; ///< of positionUnit: "pelvis at 1.05", nothing before a pose came
    UpAxis up = UpAxis::Z;    ///< of types 02, 21 and 22
    words::Fact upEvidence;   ///< "body upright along y", nothing where it is not known
};

/// What is empty is left to detection.
struct SenderOverride {
    std::optional<Revision> revision{}; ///< never Unknown
    std::optional<LengthUnit> positionUnit{};
    std::optional<UpAxis> up{};
    friend bool operator==(const SenderOverride&, const SenderOverride&) = default;
};

/// Finds a property of a sender from one pose after the other, and sticks to it: somebody may climb or fall.
template <class Value>
class Finder {
public:
    explicit Finder(Value usual) : m_value(usual) {}

    /// What one pose looks like. It is believed after `patience` poses in a row.
    void add(Value value, const words::Fact& evidence, unsigned patience, words::Kind (*name)(Value));

    [[nodiscard]] Value value() const { return m_value; }
    /// "pelvis at 1.05", nothing before there was any.
    [[nodiscard]] const words::Fact& evidence() const { return m_evidence; }
    /// The value that the sender has given up, and its evidence; nothing if there was none.
    [[nodiscard]] const words::Fact& before() const { return m_before; }

private:
    Value m_value;
    words::Fact m_evidence;
    words::Fact m_before;
    unsigned m_otherRun = 0; ///< poses in a row that look like another value
};

class UnitFinder : public Finder<LengthUnit> {
public:
    /// Poses in a row that must look like the other unit before the sender is believed to have changed it.
    static constexpr unsigned kPatience = 30;

    using Finder::Finder;
    /// Height of the pelvis and how far the other segments reach from it, in the wire's unit; a height up to
    /// 0.05 and a reach up to 0.1 are no evidence. What contradicts itself (somebody who sends centimetres
    /// lies on the floor) is none either.
    void add(double height, double reach);
    [[nodiscard]] LengthUnit unit() const { return value(); }
};

/// Gathers evidence from each header, and from the height of the pelvis in poses.
class Detector {
public:
    void addHeader(const wire::Header& header);
    /// As sent. Types of which each segment has a place in the world show the unit of positions, types 02, 21
    /// and 22 the axis that is up; others nothing.
    void addBody(const wire::Body& body);

    [[nodiscard]] Detection result() const {
        return {m_revision,       m_revisionEvidence, m_zUp.unit(),   m_yUp.unit(),
                m_zUp.evidence(), m_up.value(),       m_up.evidence()};
    }
    [[nodiscard]] UpAxis up() const { return m_up.value(); }

    /// Contradictions between headers, poses and what is declared; empty if all agrees.
    [[nodiscard]] std::vector<words::Fact> contradictions(const SenderOverride& declared) const;

private:
    /// In what headers a type has come.
    enum HeaderForm : std::uint8_t { kReserved = 1, kCounted = 2, kBoth = 3 };

    void conclude(Revision revision, words::Fact evidence);
    [[nodiscard]] std::optional<words::Fact> againstRevision(Revision declared) const;
    void addUp(const wire::Body& body);

    Revision m_revision = Revision::Unknown;
    words::Fact m_revisionEvidence;
    UnitFinder m_zUp{LengthUnit::Metre};
    UnitFinder m_yUp{LengthUnit::Centimetre};
    Finder<UpAxis> m_up{UpAxis::Z};
    std::array<std::uint8_t, 100> m_headerForms{}; ///< by type, of HeaderForm
    std::uint8_t m_allForms = 0;
    std::optional<std::uint8_t> m_typeOfBothForms{};
    std::optional<std::uint8_t> m_typeSinceJ{}; ///< the first that revision E does not know
};

} // namespace posewire::model
