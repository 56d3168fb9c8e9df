// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/base/program_state.h"
#include "app/gui/viewport/camera_state.h"
#include "app/gui/viewport/own_characters.h"
#include "app/gui/viewport/picking.h"
#include "app/gui/viewport/presenter.h"
#include "app/gui/viewport/view_look.h"
#include "core/log/time.h"

#include <QJsonObject>
#include <QTimer>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace posewire::gui {

class PaneFrame;
class PoseBanner;
class SegmentCard;
class ViewportOverlay;

/// The characters in space: builds a picture whenever the session has moved and the presenter is ready for
/// the next.
class ViewportWidget final : public QWidget {
    Q_OBJECT

public:
    ViewportWidget(model::SessionView& session, Commands& commands, QWidget* parent = nullptr);
    ~ViewportWidget() override;

    /// Makes the presenter; before that the view is empty. For after the window's first painting, since it
    /// takes time. `makeHardware` gives null where there is none; where what it gives fails, the processor
    /// draws.
    void start(Presenter* (*makeHardware)(QWidget*) = makeOpenGlPresenter);

    /// Shows another session from now on; `file` is the name of the file that it is of, empty for none.
    void showSession(model::SessionView& session, const QString& file);

    /// What is compared is drawn as well; it outlives the widget.
    void setComparison(const ComparisonState& comparison);

    /// For when the session, the selection or the view itself has changed.
    void refresh();
    void setReceiving(const ReceivingState& receiving);

    void setAxes(AxesMode mode);
    [[nodiscard]] AxesMode axes() const { return m_look.axes; }
    void toggle(Overlay overlay);
    [[nodiscard]] bool isOn(Overlay overlay) const { return m_look.overlays.has(overlay); }
    void toggleProjection();
    [[nodiscard]] render::Projection projection() const { return m_look.panes.motion().camera().projection; }
    /// Of the shown character where views are relative to the pelvis, else of the world.
    void face(render::StandardView view);
    void toggleRelativeViews();
    [[nodiscard]] bool hasRelativeViews() const { return m_hasRelativeViews; }
    /// Bodies glide from sample to sample, and a note says so.
    void toggleInterpolation();
    [[nodiscard]] bool isInterpolating() const { return m_isInterpolating; }
    /// Metres on the floor.
    void toggleScale();
    [[nodiscard]] bool hasScale() const { return m_look.hasScale; }
    /// The values of the segment under the pointer, else of the selected one.
    void toggleCard();
    [[nodiscard]] bool hasCard() const { return m_hasCard; }
    /// Keeps how the camera looks now as one of kKeptViews views; or looks like that again, and nothing where
    /// none was kept.
    static constexpr int kKeptViews = 4;
    void keepView(int index) {
        m_keptViews[static_cast<std::size_t>(index)] = stateOf(m_look.panes.motion());
    }
    void showKeptView(int index);
    [[nodiscard]] bool isKept(int index) const {
        return !m_keptViews[static_cast<std::size_t>(index)].isEmpty();
    }
    [[nodiscard]] const ViewLook& look() const { return m_look; }
    /// Into 1, 2 or 4 views. Each has a camera; what is asked of the camera is of the active one, which a
    /// click or activateNext() chooses.
    void split(int count);
    [[nodiscard]] int viewCount() const { return m_look.panes.count(); }
    void activateNext();
    /// Who is drawn by a body of the user's own.
    [[nodiscard]] OwnCharacters& ownCharacters() { return m_ownCharacters; }
    /// Camera, axes and overlays, as they are kept from one run to the next.
    [[nodiscard]] QJsonObject state() const;
    void restoreState(const QJsonObject& state);
    void frameAll();
    void frameCharacter(const model::CharacterKey& key);
    /// What the mouse does to the camera, by steps: around what it looks at, beside it, and closer.
    void orbitBy(int right, int up);
    void panBy(int right, int up);
    void zoomBy(int steps);

    /// True while what is on screen is what was last asked for, or, with data streaming, next to it.
    [[nodiscard]] bool isSettled() const;
    [[nodiscard]] const ViewportOverlay& overlay() const { return *m_overlay; }
    [[nodiscard]] QString rendererName() const {
        return m_presenter == nullptr ? QString() : m_presenter->rendererName();
    }
    /// Since the start.
    [[nodiscard]] std::uint64_t picturesShown() const {
        return m_presenter == nullptr ? 0 : m_presenter->pictures();
    }
    /// How they are drawn now, for the statistics; nothing before start().
    [[nodiscard]] PictureHealth pictureHealth() const;
    /// Null before start().
    [[nodiscard]] const SceneBuilder* builder() const { return m_builder.get(); }
    /// Why there is no picture; empty where there is one.
    [[nodiscard]] QString failure() const {
        return m_presenter == nullptr ? QString() : m_presenter->failure();
    }

signals:
    /// Axes, overlays or projection are not what they were.
    void optionsChanged();

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void changeEvent(QEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    [[nodiscard]] std::unique_ptr<SceneBuilder> makeBuilder() const;
    void use(Presenter* presenter);
    void leaveHardware();
    void drawNext();
    void onPresented();
    void updateOverlay();
    void updateWords();
    void updateCard();
    [[nodiscard]] std::optional<PickedSegment> pickAt(const QPointF& pointer) const;
    [[nodiscard]] float aspect() const;
    /// Radians; of the shown character where views are relative to the pelvis.
    [[nodiscard]] float heading() const;
    void activate(int pane);
    /// Of the pane under the pointer.
    [[nodiscard]] QRect paneAt(const QPointF& pointer) const;
    void updatePanes(const SceneFrame& shown);

    model::SessionView* m_session;
    QString m_file; ///< that the session is of; empty for none
    Commands& m_commands;
    bool m_isHardware = false;
    QString m_hardwareFailure; ///< why the processor draws after all; empty where it does not
    ViewLook m_look;
    OwnCharacters m_ownCharacters;
    bool m_hasRelativeViews = true;
    bool m_isInterpolating = false;
    const ComparisonState* m_comparison = nullptr;
    QTimer m_glideTimer; ///< until the next picture of bodies on their way
    bool m_hasCard = true;
    std::array<QJsonObject, kKeptViews> m_keptViews; ///< as by stateOf(); empty where none was kept
    std::unique_ptr<SceneBuilder> m_builder;
    Presenter* m_presenter = nullptr;
    ViewportOverlay* m_overlay;
    std::array<ViewportOverlay*, ViewPanes::kMost> m_paneOverlays{}; ///< shown where the view is split
    PaneFrame* m_paneFrame;
    PoseBanner* m_banner;
    SegmentCard* m_card;
    log::Stamp m_wordsStamp{}; ///< of what banner and card were made from
    model::Selection m_wordsSelection;
    ReceivingState m_receiving;
    std::shared_ptr<const SceneFrame> m_drawing; ///< with the presenter
    std::shared_ptr<const SceneFrame> m_shown;
    bool m_isOutdated = true;
    log::Stamp m_followed{};
    std::uint64_t m_followedPacket = 0; ///< of a moment at rest
    log::Stamp m_drawingBuilt{};        ///< the session's time of m_drawing
    log::Stamp m_shownBuilt{};
    bool m_hasPicture = false;
    QPointF m_pressed;
    QPointF m_pointer;
    bool m_isDragging = false;
    QTimer m_hoverTimer;
    std::optional<PickedSegment> m_hovered; ///< under a pointer that rests
};

} // namespace posewire::gui
