// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/gui/viewport/scene.h"
#include "render/quality_ladder.h"

#include <QWidget>

#include <cstdint>
#include <memory>

namespace posewire::gui {

struct PictureLoad {
    render::Simplification step = render::Simplification::None;
    double typical = 0;   ///< seconds a picture takes; 0 if that is not known
    double cause = 0;     ///< seconds one took before the last step down; 0 if there was none
    double budget = 0;    ///< seconds one may take; 0 if nothing is left out
    bool isStill = false; ///< nothing moves: what is shown was drawn as well as it can be
};

/// Brings frames to the screen, one at a time: present() is for when isReady() says so, presented() reports
/// that the frame is shown, and ready() that the next may come where that is later.
class Presenter : public QWidget {
    Q_OBJECT

public:
    using QWidget::QWidget;

    [[nodiscard]] virtual bool isReady() const = 0;
    virtual void present(std::shared_ptr<const SceneFrame> frame) = 0;

    /// GL_RENDERER, for diagnostics; empty before the first picture.
    [[nodiscard]] virtual QString rendererName() const = 0;
    /// Why there is no picture; empty if there is one or there may still be.
    [[nodiscard]] virtual QString failure() const = 0;

    [[nodiscard]] virtual PictureLoad load() const = 0;
    [[nodiscard]] virtual std::uint64_t pictures() const = 0;

signals:
    void presented();
    void ready();
    /// What is shown is of another size than the view, as after a move to a screen of another scale.
    void outgrown();
};

/// Draws straight into the window by graphics hardware. Null where windows cannot be drawn so: on platforms
/// on which QOpenGLWidget does not work at all (it crashes there), below OpenGL 3.3, or where the processor
/// draws.
[[nodiscard]] Presenter* makeOpenGlPresenter(QWidget* parent);

/// Draws on a thread and paints the pictures with QPainter: for software OpenGL, and for platforms without
/// any.
[[nodiscard]] Presenter* makeSoftwarePresenter(QWidget* parent);

/// The OpenGL that there is without a window, or why there is none: for --version, which opens none.
[[nodiscard]] QString windowlessOpenGlName();

/// What the statistics say of the viewport's pictures: on which step of leaving things out they are, and why.
/// `hardwareFailure` says why the processor draws where there was hardware; empty for none.
[[nodiscard]] PictureHealth pictureHealthOf(const PictureLoad& load, const QString& hardwareFailure = {});

} // namespace posewire::gui
