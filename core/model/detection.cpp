// SPDX-License-Identifier: MIT
#include "core/model/detection.h"

#include "core/wire/messages.h"

#include <cstdio>

namespace posewire::model {

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
    if (header.bodySegments != 0 || header.payloadSize != 0) {
        conclude(Revision::N, "header has counts and payload size");
    } else if (type == wire::NullPose::kType || type >= wire::JointAngles::kType) {
        conclude(Revision::JOrK, "type 13 or 20 to 25 with a reserved header");
    } else if (type == wire::ScaleInformation::kType || type == wire::PropInformation::kType ||
               type == wire::TagPositions::kType) {
        conclude(Revision::E, "deprecated types 04, 10 or 11 on the air");
    }
}

void Detector::addPelvisHeight(double height) {
    if (m_hasUnit || !(height > 0.05)) {
        return;
    }
    m_hasUnit = true;
    m_result.positionUnit = detectLengthUnit(height);
    char text[64];
    std::snprintf(text, sizeof text, "pelvis at %.2f", height);
    m_result.unitEvidence = text;
}

} // namespace posewire::model
