// SPDX-License-Identifier: MIT
#include "core/model/session/detection.h"

#include "core/model/body/segments.h"
#include "core/wire/messages.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::model {
namespace {

template <class Position>
double distance(const Position& a, const Position& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Segments without finite positions are left out.
template <class Item>
double reachOf(const std::vector<Item>& segments) {
    double reach = 0;
    for (std::size_t i = 1; i < std::min<std::size_t>(segments.size(), kBodySegmentCount); ++i) {
        const double next = distance(segments[i].position, segments[0].position);
        reach = std::isfinite(next) ? std::max(reach, next) : reach;
    }
    return reach;
}

bool isSinceJ(const wire::TypeInfo* info) {
    return info != nullptr && info->firstRevision() >= 'J';
}

bool isOfEAlone(const wire::TypeInfo* info) {
    return info != nullptr && info->firstRevision() == 'E' && info->isInOneRevision();
}

} // namespace

words::Kind revisionName(Revision revision) {
    using enum words::Kind;
    constexpr std::array kNames{RevisionUnknown, RevisionE, RevisionJOrK, RevisionN};
    return kNames[static_cast<std::size_t>(revision)];
}

words::Kind unitName(LengthUnit unit) {
    return unit == LengthUnit::Metre        ? words::Kind::Metres
           : unit == LengthUnit::Centimetre ? words::Kind::Centimetres
                                            : words::Kind::Millimetres;
}

/// Evidence only ever grows: header counts outweigh message types, and those that only E has outweigh common
/// ones.
void Detector::addHeader(const wire::Header& header) {
    const std::uint8_t type = header.type();
    const bool isCounted = header.bodySegments != 0 || header.payloadSize != 0;
    noteHeaderForm(type, isCounted ? kCounted : kReserved);
    const wire::TypeInfo* info = wire::findType(type);
    if (!m_typeSinceJ && isSinceJ(info)) {
        m_typeSinceJ = type;
    }
    if (isCounted && m_revision < Revision::N) {
        conclude(Revision::N, words::Kind::CountsInHeader);
    } else if (!isCounted && isSinceJ(info) && m_revision < Revision::JOrK) {
        conclude(Revision::JOrK, {words::Kind::ReservedHeader, {{"type", wire::typeDigits(type)}}});
    } else if (!isCounted && isOfEAlone(info) && m_revision < Revision::E) {
        conclude(Revision::E, {words::Kind::DeprecatedType, {{"type", wire::typeDigits(type)}}});
    }
}

void Detector::conclude(Revision revision, words::Fact evidence) {
    m_revision = revision;
    m_revisionEvidence = std::move(evidence);
}

void Detector::noteHeaderForm(std::uint8_t type, HeaderForm form) {
    m_allForms |= form;
    std::uint8_t& forms = m_headerForms[type % m_headerForms.size()];
    forms |= form;
    if (forms == kBoth && !m_typeOfBothForms) {
        m_typeOfBothForms = type;
    }
}

void UnitFinder::add(double height, double reach) {
    const bool hasHeight = height > 0.05;
    const bool hasReach = reach >= 0.1;
    const LengthUnit unit = detectLengthUnit(hasHeight ? height : reach);
    const bool isOfBody = hasReach || unit != LengthUnit::Millimetre; // an object may be high up
    if (!(hasHeight || hasReach) || !isOfBody || (hasHeight && hasReach && detectLengthUnit(reach) != unit)) {
        return;
    }
    m_otherRun = unit == m_unit ? 0 : m_otherRun + 1;
    const bool isChange = m_otherRun == kPatience;
    if (!m_evidence.isNothing() && !isChange) {
        return;
    }
    if (isChange) {
        m_before = {words::Kind::UnitBy,
                    {{"looks", words::Fact(unitName(m_unit))}, {"evidence", m_evidence}}};
    }
    m_evidence = {hasHeight ? words::Kind::PelvisAt : words::Kind::ReachOf,
                  {{"value", words::Number{hasHeight ? height : reach, 2}}}};
    m_unit = unit;
    m_otherRun = 0;
}

void Detector::addBody(const wire::Body& body) {
    const auto add = [this](const auto& message) {
        if constexpr (requires { message.segments.front().position; }) {
            static const wire::TypeInfo& info = *wire::findType(message.kType);
            const bool isYUp = info.frame == wire::Frame::YUp;
            const bool isZUp = info.frame == wire::Frame::ZUp && info.isSampled;
            if ((isYUp || isZUp) && !message.segments.empty()) {
                UnitFinder& finder = isYUp ? m_yUp : m_zUp;
                finder.add(message.segments.front().position[isYUp ? 1 : 2], reachOf(message.segments));
            }
        }
    };
    std::visit(add, body);
}

std::optional<words::Fact> Detector::againstRevision(Revision declared) const {
    using K = words::Kind;
    const words::NamedValue said{"declared", words::Fact(revisionName(declared))};
    const bool hasCounts = (m_allForms & kCounted) != 0;
    if (declared != Revision::N && hasCounts) {
        return words::Fact{K::SendsCounts, {said}};
    }
    if (declared == Revision::N && m_allForms == kReserved) {
        return words::Fact{K::SendsNoCounts, {said}};
    }
    if (declared == Revision::E && m_typeSinceJ) {
        return words::Fact{K::SendsTypeSinceJ, {said, {"type", wire::typeDigits(*m_typeSinceJ)}}};
    }
    return std::nullopt;
}

std::vector<words::Fact> Detector::contradictions(const SenderOverride& declared) const {
    using K = words::Kind;
    std::vector<words::Fact> found;
    if (declared.revision) {
        if (auto one = againstRevision(*declared.revision)) {
            found.push_back(std::move(*one));
        }
    }
    if (m_typeOfBothForms) {
        found.push_back({K::CountsComeAndGo, {{"type", wire::typeDigits(*m_typeOfBothForms)}}});
    }
    const words::NamedValue looks{"looks", words::Fact(unitName(m_zUp.unit()))};
    const words::NamedValue evidence{"evidence", m_zUp.evidence()};
    if (declared.positionUnit && !m_zUp.evidence().isNothing() && *declared.positionUnit != m_zUp.unit()) {
        found.push_back(
            {K::ReadInOtherUnit, {looks, evidence, {"read", words::Fact(unitName(*declared.positionUnit))}}});
    }
    if (!m_zUp.before().isNothing()) {
        found.push_back({K::UnitChanged, {looks, evidence, {"before", m_zUp.before()}}});
    }
    return found;
}

} // namespace posewire::model
