// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"
#include "core/log/time.h"
#include "core/model/body/null_pose_findings.h"
#include "core/model/body/null_pose_measures.h"
#include "core/model/session/session_view.h"

#include <optional>
#include <vector>

namespace posewire::gui {

/// What types 13, 10 and 11 said of the shown character at the cursor, with all that follows from it. Copied,
/// and worked out again only where something else was said.
class NullPoseReading {
public:
    explicit NullPoseReading(model::SessionView& view) : m_view(view) {}

    /// True where something else is to be shown than before; ages apart.
    bool refresh();

    [[nodiscard]] const std::optional<model::CharacterKey>& character() const { return m_signature.key; }
    /// Null where none was received.
    [[nodiscard]] const model::NullPose* pose() const { return m_pose ? &*m_pose : nullptr; }
    [[nodiscard]] const model::BodyPlaces& places() const { return m_places; }
    [[nodiscard]] const model::NullPoseMeasures& measures() const { return m_measures; }
    [[nodiscard]] const std::vector<model::NullPoseFinding>& findings() const { return m_findings; }
    [[nodiscard]] const wire::ScaleInformation* scale() const { return m_scale ? &*m_scale : nullptr; }
    [[nodiscard]] const wire::PropInformation* props() const { return m_props ? &*m_props : nullptr; }
    /// True where nothing of the three types has come.
    [[nodiscard]] bool isEmpty() const { return !m_pose && !m_scale && !m_props && messages() == 0; }

    /// By place; empty where there is nothing to compare with, and the first where nothing has changed.
    [[nodiscard]] const model::Distances& fromBefore() const { return m_fromBefore; }
    [[nodiscard]] const model::Distances& fromReference() const { return m_fromReference; }
    [[nodiscard]] log::Stamp changed() const { return m_signature.changed; }

    /// The newest message, complete or not; nothing where there is none.
    [[nodiscard]] const std::optional<model::NullPoseMessage>& newest() const { return m_newest; }
    [[nodiscard]] std::uint64_t messages() const { return m_signature.messages; }
    [[nodiscard]] log::Duration repetition() const { return m_repetition; }
    [[nodiscard]] log::Stamp scaleStamp() const { return m_signature.scaleStamp; }
    [[nodiscard]] model::SessionView& view() const { return m_view; }

    /// The place in the message of the selected segment, −1 for none.
    [[nodiscard]] int selectedPlace() const;
    /// The segment to select for a place: of the body by what it is, else the place itself.
    [[nodiscard]] int segmentAt(int place) const;

private:
    struct Signature {
        std::optional<model::CharacterKey> key{};
        std::uint64_t packet = 0;
        std::uint64_t messages = 0;
        std::uint64_t scalePacket = UINT64_MAX;
        log::Stamp scaleStamp{};
        std::uint64_t propPacket = UINT64_MAX;
        log::Stamp changed{};
        int segments = 0; ///< of poses
        bool isOverdue = false;
        bool isDue = false;
        friend bool operator==(const Signature&, const Signature&) = default;
    };
    [[nodiscard]] Signature signatureOf(const model::CharacterKey& key,
                                        const model::NullPoseEvidence& evidence) const;
    void take(const model::NullPoseEvidence& evidence);

    model::SessionView& m_view;
    Signature m_signature;
    std::optional<model::NullPose> m_pose;
    model::BodyPlaces m_places{};
    model::NullPoseMeasures m_measures;
    std::vector<model::NullPoseFinding> m_findings;
    std::optional<wire::ScaleInformation> m_scale;
    std::optional<wire::PropInformation> m_props;
    model::Distances m_fromBefore;
    model::Distances m_fromReference;
    std::optional<model::NullPoseMessage> m_newest;
    log::Duration m_repetition{};
};

/// When and how completely scale messages came, and the size of the body. The reading must outlive them.
[[nodiscard]] std::vector<Property> nullPoseFacts(const NullPoseReading& reading);

[[nodiscard]] Health healthOf(model::Severity severity);

/// Findings as lines to copy: symbol, what, what it means.
[[nodiscard]] QString findingsText(const std::vector<model::NullPoseFinding>& findings);

} // namespace posewire::gui
