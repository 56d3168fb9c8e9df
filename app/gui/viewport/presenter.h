// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene.h"

#include <QWidget>

#include <memory>

namespace posewire::gui {

/// Brings frames to the screen, one at a time: present() is for when isReady() says so, and presented()
/// reports when the next may come.
class Presenter : public QWidget {
    Q_OBJECT

public:
    using QWidget::QWidget;

    [[nodiscard]] virtual bool isReady() const = 0;
    virtual void present(std::shared_ptr<const SceneFrame> frame) = 0;

    /// GL_RENDERER, for diagnostics; empty before the first picture.
    [[nodiscard]] virtual QString rendererName() const = 0;
    /// Why there is no picture; empty where there is one or there may still be.
    [[nodiscard]] virtual QString failure() const = 0;

signals:
    void presented();
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

} // namespace posewire::gui
