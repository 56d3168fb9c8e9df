// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/bodies.h"
#include "app/gui/viewport/camera_motion.h"
#include "app/gui/viewport/presenter.h"

#include <QWidget>

#include <memory>

namespace posewire::gui {

/// A body in MVN's T-pose on a floor of its own; dragging turns it.
class BodyPreview final : public QWidget {
    Q_OBJECT

public:
    explicit BodyPreview(QWidget* parent);

    /// Null shows the empty floor.
    void setBody(std::shared_ptr<const DressedBody> body);
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void draw();

    Presenter* m_presenter;
    Figure m_figure; ///< without anything drawn for none
    CameraMotion m_motion;
    QPointF m_pointer;
    bool m_isWaiting = false; ///< for the presenter to be ready
};

} // namespace posewire::gui
