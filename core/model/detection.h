// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/spaces.h"
#include "core/wire/codec.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace posewire::model {

/// Which revision of the specification a sender follows, as far as its datagrams tell.
enum class Revision : std::uint8_t { Unknown, E, JOrK, N };
[[nodiscard]] std::string_view revisionName(Revision revision);

/// What was concluded about a source, and from what.
struct Detection {
    Revision revision = Revision::Unknown;
    std::string revisionEvidence;                ///< "header counts and payload size"
    LengthUnit positionUnit = LengthUnit::Metre; ///< of types 02, 21 and 24
    std::string unitEvidence;                    ///< "pelvis at 1.05", empty before a pose came
};

/// Gathers evidence. Looks at few datagrams: each header, and a pose now and then.
class Detector {
public:
    void addHeader(const wire::Header& header);
    /// Height of a pelvis in the wire's unit, from type 02 or 21.
    void addPelvisHeight(double height);

    [[nodiscard]] const Detection& result() const { return m_result; }

private:
    Detection m_result;
    bool m_hasUnit = false;
};

} // namespace posewire::model
