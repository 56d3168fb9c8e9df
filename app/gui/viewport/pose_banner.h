// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"
#include "core/model/session/session_view.h"

#include <QWidget>

#include <vector>

namespace posewire::gui {

struct PoseNote {
    Health level = Health::Unknown;
    QString text;
    friend bool operator==(const PoseNote&, const PoseNote&) = default;
};

/// Of all characters that are drawn: assumed ones first, those alike together, at most `most` notes, the last
/// of which says how many more there are.
[[nodiscard]] std::vector<PoseNote> poseNotes(const model::SessionView& session, std::size_t most);

/// Says in the viewport what of the figures was not sent, and offers to put those on the floor that are below
/// it. Hidden where there is nothing to say.
class PoseBanner final : public QWidget {
    Q_OBJECT

public:
    static constexpr std::size_t kMost = 3;

    PoseBanner(Commands& commands, QWidget* parent);

    /// `isInterpolated`: between samples bodies are shown where none was sent.
    void refresh(const model::SessionView& session, bool isInterpolated = false);
    /// Into the lower left corner of a viewport of that size.
    void place(const QSize& viewport);
    [[nodiscard]] const std::vector<PoseNote>& notes() const { return m_notes; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void showNotes();

    std::vector<PoseNote> m_notes;
    std::vector<model::CharacterKey> m_below; ///< the floor
    QLabel* m_text;
    QToolButton* m_floor;
};

} // namespace posewire::gui
