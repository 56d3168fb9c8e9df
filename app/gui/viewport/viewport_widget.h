// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/viewport/picking.h"
#include "app/gui/viewport/picture_loop.h"
#include "app/gui/viewport/pose_banner.h"
#include "app/gui/viewport/segment_card.h"
#include "app/gui/viewport/view_choice.h"
#include "app/gui/viewport/viewport_overlay.h"

#include <array>
#include <optional>

namespace posewire::gui {

class PaneFrame;

/// The characters in space: their picture, what lies over it, and what the pointer does to it.
class ViewportWidget final : public QWidget {
    Q_OBJECT

public:
    ViewportWidget(model::SessionView& session, Commands& commands, QWidget* parent = nullptr);

    [[nodiscard]] PictureLoop& pictures() { return *m_pictures; }
    [[nodiscard]] const PictureLoop& pictures() const { return *m_pictures; }
    [[nodiscard]] ViewChoice& choice() { return *m_choice; }
    [[nodiscard]] const ViewChoice& choice() const { return *m_choice; }
    [[nodiscard]] const ViewportOverlay& overlay() const { return *m_overlay; }

    /// Shows another session from now on; `file` is the name of the file that it is of, empty for none.
    void showSession(model::SessionView& session, const QString& file);
    void setReceiving(const ReceivingState& receiving);
    /// For when the session or the selection has changed.
    void refresh() { m_pictures->refresh(); }

    /// Of the shown character if views are relative to the pelvis, else of the world.
    void face(render::StandardView view) { m_choice->face(view, heading()); }
    void split(int count) { m_choice->split(count, heading()); }
    void frameAll();
    void frameCharacter(const model::CharacterKey& key);

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    void updateOverlay();
    void updateWords();
    void updateCard();
    void updatePanes();
    [[nodiscard]] std::optional<PickedSegment> pickAt(const QPointF& pointer) const;
    /// Radians; of the shown character if views are relative to the pelvis.
    [[nodiscard]] float heading() const;

    model::SessionView* m_session;
    QString m_file; ///< that the session is of; empty for none
    Commands& m_commands;
    ViewChoice* m_choice = new ViewChoice(this);
    PictureLoop* m_pictures;
    ViewportOverlay* m_overlay = new ViewportOverlay(this);
    std::array<ViewportOverlay*, ViewPanes::kMost> m_paneOverlays{}; ///< shown while the view is split
    PaneFrame* m_paneFrame;
    PoseBanner* m_banner = new PoseBanner(m_commands, this);
    SegmentCard* m_card = new SegmentCard(this, *m_banner);
    log::Stamp m_wordsStamp{}; ///< of what banner and card were made from
    model::Selection m_wordsSelection;
    ReceivingState m_receiving;
    QPointF m_pressed;
    QPointF m_pointer;
    bool m_isDragging = false;
    QTimer m_hoverTimer;
    std::optional<PickedSegment> m_hovered; ///< under a pointer that rests
};

} // namespace posewire::gui
