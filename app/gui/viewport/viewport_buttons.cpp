// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/viewport_buttons.h"

#include "app/gui/viewport/viewport_widget.h"

#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>

#include <array>
#include <utility>

namespace posewire::gui {

namespace {

QToolButton* button(QWidget* parent, const QString& toolTip) {
    auto* result = new QToolButton(parent);
    result->setProperty("framed", true);
    result->setToolTip(toolTip);
    result->setFocusPolicy(Qt::TabFocus);
    return result;
}

} // namespace

ViewportButtons::ViewportButtons(ViewportWidget* viewport)
    : QWidget(viewport),
      m_axes(button(this, tr("Local axes of the segments: x red, y green, z blue"))),
      m_frame(button(this, tr("Show all characters, and keep them in the picture"))),
      m_projection(button(this, tr("Perspective or orthographic"))) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 12, 12, 12);
    row->setSpacing(8);
    row->addWidget(m_axes);
    row->addWidget(m_frame);
    row->addWidget(m_projection);

    const std::array modes{std::pair{AxesMode::All, tr("All segments")},
                           std::pair{AxesMode::Selected, tr("Selected character")},
                           std::pair{AxesMode::None, tr("None")}};
    auto* menu = new QMenu(m_axes);
    for (const auto& [mode, text] : modes) {
        menu->addAction(text, viewport, [viewport, mode = mode] { viewport->setAxes(mode); });
    }
    m_axes->setMenu(menu);
    m_axes->setPopupMode(QToolButton::InstantPopup);
    m_frame->setText(tr("Frame  F"));
    connect(m_frame, &QToolButton::clicked, viewport, &ViewportWidget::frameAll);
    connect(m_projection, &QToolButton::clicked, viewport, [viewport] {
        const bool isPerspective = viewport->projection() == render::Projection::Perspective;
        viewport->setProjection(isPerspective ? render::Projection::Orthographic
                                              : render::Projection::Perspective);
    });
    connect(viewport, &ViewportWidget::optionsChanged, this, [this, viewport] { showOptions(*viewport); });
    showOptions(*viewport);
}

void ViewportButtons::showOptions(const ViewportWidget& viewport) {
    const std::array names{tr("all"), tr("selected"), tr("none")};
    m_axes->setText(tr("Axes: %1 ▾").arg(names[static_cast<std::size_t>(viewport.axes())]));
    m_projection->setText(viewport.projection() == render::Projection::Perspective ? tr("Persp")
                                                                                   : tr("Ortho"));
    adjustSize();
}

} // namespace posewire::gui
