// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/gui/viewport/presenter.h"
#include "app/gui/viewport/view_look.h"

#include <QTimer>

namespace posewire::gui {

/// Keeps the picture of a viewport up to date: builds a frame whenever something has changed and the
/// presenter is ready for the next.
class PictureLoop final : public QObject {
    Q_OBJECT

public:
    /// Draws into `view`; session and look must outlive it.
    PictureLoop(model::SessionView& session, ViewLook& look, QWidget* view);

    /// Makes the presenter; before that the view is empty. For after the window's first painting, since it
    /// takes time. `makeHardware` gives null if there is none; if what it gives fails, the processor draws.
    void start(Presenter* (*makeHardware)(QWidget*) = makeOpenGlPresenter);
    void showSession(model::SessionView& session);
    /// Draws the compared recording as well; it outlives this.
    void setComparison(const ComparisonState& comparison);
    void setInterpolating(bool isInterpolating) { m_isInterpolating = isInterpolating; }
    /// For when the session, the selection, the look or the size of the view has changed.
    void refresh();

    /// True while what is on screen is what was last asked for, or, with data streaming, next to it.
    [[nodiscard]] bool isSettled() const;
    /// True while a picture is being drawn; presented() is emitted once it is done.
    [[nodiscard]] bool isDrawing() const { return m_drawing != nullptr; }
    [[nodiscard]] const SceneFrame* shown() const { return m_shown.get(); }
    /// Empty before start(), as are the following.
    [[nodiscard]] QString rendererName() const {
        return m_presenter == nullptr ? QString() : m_presenter->rendererName();
    }
    /// Since the start.
    [[nodiscard]] std::uint64_t count() const { return m_presenter == nullptr ? 0 : m_presenter->pictures(); }
    [[nodiscard]] PictureHealth health() const;
    [[nodiscard]] const SceneBuilder* builder() const { return m_builder.get(); }
    /// Why there is no picture; empty if there is one.
    [[nodiscard]] QString failure() const {
        return m_presenter == nullptr ? QString() : m_presenter->failure();
    }

signals:
    void presented();
    /// The pause after a picture is over, and the next one is about to be drawn.
    void due();

private:
    [[nodiscard]] std::unique_ptr<SceneBuilder> makeBuilder() const;
    void use(Presenter* presenter);
    void leaveHardware();
    void drawNext();
    void onPresented();

    model::SessionView* m_session;
    ViewLook& m_look;
    QWidget& m_view;
    std::unique_ptr<SceneBuilder> m_builder;
    Presenter* m_presenter = nullptr;
    bool m_isHardware = false;
    QString m_hardwareFailure; ///< why the processor draws after all; empty if it does not
    bool m_isInterpolating = false;
    const ComparisonState* m_comparison = nullptr;
    QTimer m_glideTimer;                         ///< until the next picture of bodies on their way
    std::shared_ptr<const SceneFrame> m_drawing; ///< with the presenter
    std::shared_ptr<const SceneFrame> m_shown;
    bool m_isOutdated = true;
    bool m_hasPicture = false;
    log::Stamp m_followed{};
    std::uint64_t m_followedPacket = 0; ///< of a moment at rest
    log::Stamp m_followedMoment{};
    log::Stamp m_drawingBuilt{}; ///< the session's time of m_drawing
    log::Stamp m_shownBuilt{};
};

} // namespace posewire::gui
