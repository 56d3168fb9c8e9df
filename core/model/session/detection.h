// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/spaces.h"
#include "core/wire/codec.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::model {

/// Which revision of the specification a sender follows, as far as its datagrams tell.
enum class Revision : std::uint8_t { Unknown, E, JOrK, N };
[[nodiscard]] std::string_view revisionName(Revision revision);

/// "metres", "centimetres".
[[nodiscard]] std::string_view unitName(LengthUnit unit);

/// What was concluded about a sender, and from what.
struct Detection {
    Revision revision = Revision::Unknown;
    std::string revisionEvidence;                ///< "header counts and payload size"
    LengthUnit positionUnit = LengthUnit::Metre; ///< of types 02, 21 and 24
    std::string unitEvidence;                    ///< "pelvis at 1.05", empty before a pose came
};

/// What the operator says about a sender; what is empty is left to detection.
struct SenderOverride {
    std::optional<Revision> revision{}; ///< never Unknown
    std::optional<LengthUnit> positionUnit{};
    friend bool operator==(const SenderOverride&, const SenderOverride&) = default;
};

/// Two things about a sender that cannot both be so.
struct Contradiction {
    std::string brief; ///< for a cell or a label: "declared J or K, sends counts"
    std::string text;  ///< the sentence: "declared J or K, but header counts are filled"
};

/// Gathers evidence from each header, and from the height of the pelvis in poses.
class Detector {
public:
    /// So many poses in a row must look like the other unit before it is believed that the sender has
    /// changed it: somebody may climb or fall.
    static constexpr unsigned kUnitPatience = 30;

    void addHeader(const wire::Header& header);
    /// Height of a pelvis in the wire's unit, from type 02 or 21.
    void addPelvisHeight(double height);

    [[nodiscard]] const Detection& result() const { return m_result; }

    /// What arrives against what is declared, and against what arrived before; empty where all agrees.
    [[nodiscard]] std::vector<Contradiction> contradictions(const SenderOverride& declared) const;

private:
    /// In what headers a type has come.
    enum HeaderForm : std::uint8_t { kReserved = 1, kCounted = 2, kBoth = 3 };

    void noteHeaderForm(std::uint8_t type, HeaderForm form);
    [[nodiscard]] std::optional<Contradiction> againstRevision(Revision declared) const;

    Detection m_result;
    std::array<std::uint8_t, 100> m_headerForms{}; ///< by type, of HeaderForm
    std::uint8_t m_allForms = 0;
    std::optional<std::uint8_t> m_typeOfBothForms{};
    std::optional<std::uint8_t> m_typeSinceJ{}; ///< the first that revision E does not know
    bool m_hasUnit = false;
    unsigned m_otherUnitRun = 0; ///< poses in a row that look like the other unit
    std::string m_unitBefore;    ///< evidence for the unit that the sender has given up; empty for none
};

} // namespace posewire::model
