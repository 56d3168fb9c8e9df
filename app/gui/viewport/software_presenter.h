// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/drawing_thread.h"
#include "app/gui/viewport/presenter.h"

#include <QImage>

#include <memory>

namespace posewire::gui {

/// Pictures from a drawing thread, painted with QPainter: for software OpenGL, and for platforms without any.
class SoftwarePresenter final : public Presenter {
    Q_OBJECT

public:
    explicit SoftwarePresenter(QWidget* parent);
    ~SoftwarePresenter() override;

    [[nodiscard]] bool isReady() const override { return !m_isDrawing && m_failure.isEmpty(); }
    void present(std::shared_ptr<const SceneFrame> frame) override;
    [[nodiscard]] QString rendererName() const override { return m_rendererName; }
    [[nodiscard]] QString failure() const override { return m_failure; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void take();

    QImage m_picture;
    QString m_rendererName;
    QString m_failure;
    bool m_isDrawing = false;
    std::unique_ptr<DrawingThread> m_thread;
};

} // namespace posewire::gui
