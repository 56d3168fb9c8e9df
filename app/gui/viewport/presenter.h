// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene_frame.h"

#include <QWidget>

#include <memory>

namespace posewire::gui {

/// Brings frames to the screen. One frame is in the making at a time: present() is for when isReady() says
/// so, and presented() tells when the next may come.
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

} // namespace posewire::gui
