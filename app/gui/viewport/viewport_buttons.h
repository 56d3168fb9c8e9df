// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QToolButton;

namespace posewire::gui {

class ViewportWidget;

/// The few choices that lie over the picture: axes, framing, projection.
class ViewportButtons final : public QWidget {
    Q_OBJECT

public:
    explicit ViewportButtons(ViewportWidget* viewport);

private:
    void showOptions(const ViewportWidget& viewport);

    QToolButton* m_axes;
    QToolButton* m_frame;
    QToolButton* m_projection;
};

} // namespace posewire::gui
