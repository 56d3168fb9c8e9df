// SPDX-License-Identifier: MIT
#include "core/model/session/detection.h"

#include "core/wire/messages.h"
#include "core/wire/type_table.h"

#include <cstdio>

namespace posewire::model {
namespace {

std::string pelvisText(double height) {
    char text[64];
    std::snprintf(text, sizeof text, "pelvis at %.2f", height);
    return text;
}

bool isSinceJ(std::uint8_t type) {
    return type == wire::NullPose::kType ||
           (type >= wire::JointAngles::kType && type <= wire::TimeCode::kType);
}

std::string typeText(std::uint8_t type) {
    const auto digits = wire::typeDigits(type);
    return "type " + std::string(digits.data(), digits.size());
}

std::string declaredText(Revision revision) {
    return "declared " + std::string(revisionName(revision));
}

} // namespace

std::string_view revisionName(Revision revision) {
    switch (revision) {
    case Revision::Unknown:
        return "not known yet";
    case Revision::E:
        return "E";
    case Revision::JOrK:
        return "J or K";
    case Revision::N:
        return "L to N";
    }
    return "";
}

std::string_view unitName(LengthUnit unit) {
    return unit == LengthUnit::Metre ? "metres" : "centimetres";
}

/// Evidence only ever grows: header counts outweigh message types, and those that only E has outweigh common
/// ones.
void Detector::addHeader(const wire::Header& header) {
    const auto conclude = [&](Revision revision, const char* evidence) {
        if (m_result.revision < revision) {
            m_result.revision = revision;
            m_result.revisionEvidence = evidence;
        }
    };
    const std::uint8_t type = header.type();
    const bool isCounted = header.bodySegments != 0 || header.payloadSize != 0;
    noteHeaderForm(type, isCounted ? kCounted : kReserved);
    if (!m_typeSinceJ && isSinceJ(type)) {
        m_typeSinceJ = type;
    }
    if (isCounted) {
        conclude(Revision::N, "counts in its header");
    } else if (type == wire::NullPose::kType || type >= wire::JointAngles::kType) {
        conclude(Revision::JOrK, "type 13 or 20 to 25 with a reserved header");
    } else if (type == wire::ScaleInformation::kType || type == wire::PropInformation::kType ||
               type == wire::TagPositions::kType) {
        conclude(Revision::E, "deprecated types 04, 10 or 11 on the air");
    }
}

void Detector::noteHeaderForm(std::uint8_t type, HeaderForm form) {
    m_allForms |= form;
    std::uint8_t& forms = m_headerForms[type % m_headerForms.size()];
    forms |= form;
    if (forms == kBoth && !m_typeOfBothForms) {
        m_typeOfBothForms = type;
    }
}

void Detector::addPelvisHeight(double height) {
    if (!(height > 0.05)) {
        return;
    }
    const LengthUnit unit = detectLengthUnit(height);
    if (!m_hasUnit) {
        m_hasUnit = true;
        m_result.positionUnit = unit;
        m_result.unitEvidence = pelvisText(height);
        return;
    }
    m_otherUnitRun = unit == m_result.positionUnit ? 0 : m_otherUnitRun + 1;
    if (m_otherUnitRun == kUnitPatience) {
        m_otherUnitRun = 0;
        m_unitBefore = std::string(unitName(m_result.positionUnit)) + " (" + m_result.unitEvidence + ')';
        m_result.positionUnit = unit;
        m_result.unitEvidence = pelvisText(height);
    }
}

std::optional<Contradiction> Detector::againstRevision(Revision declared) const {
    const std::string said = declaredText(declared);
    const bool hasCounts = (m_allForms & kCounted) != 0;
    if (declared != Revision::N && hasCounts) {
        return Contradiction{said + ", sends counts", said + ", but header counts are filled"};
    }
    if (declared == Revision::N && m_allForms == kReserved) {
        return Contradiction{said + ", sends no counts", said + ", but header bytes 17 to 23 are zero"};
    }
    if (declared == Revision::E && m_typeSinceJ) {
        const std::string type = typeText(*m_typeSinceJ);
        return Contradiction{said + ", sends " + type,
                             said + ", but " + type + " is on the air, which came with J"};
    }
    return std::nullopt;
}

std::vector<Contradiction> Detector::contradictions(const SenderOverride& declared) const {
    std::vector<Contradiction> found;
    if (declared.revision) {
        if (auto one = againstRevision(*declared.revision)) {
            found.push_back(std::move(*one));
        }
    }
    if (m_typeOfBothForms) {
        found.push_back({"header counts come and go",
                         typeText(*m_typeOfBothForms) +
                             " came with header counts and without: the sender has changed its revision"});
    }
    const std::string looks = std::string(unitName(m_result.positionUnit));
    if (declared.positionUnit && m_hasUnit && *declared.positionUnit != m_result.positionUnit) {
        const std::string read = std::string(unitName(*declared.positionUnit));
        found.push_back({"looks like " + looks + ", read as " + read,
                         "positions look like " + looks + " (" + m_result.unitEvidence + "), read as " +
                             read + " because you said so"});
    }
    if (!m_unitBefore.empty()) {
        found.push_back({"unit has changed to " + looks, "positions were in " + m_unitBefore +
                                                             " and are in " + looks + " now (" +
                                                             m_result.unitEvidence + ')'});
    }
    return found;
}

} // namespace posewire::model
