// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QScrollArea>

namespace posewire::gui {

/// Lets a dock become lower than its content, which then scrolls: the least heights of docks above each other
/// must not add up to more than the screen has.
class DockScroll final : public QScrollArea {
    Q_OBJECT

public:
    explicit DockScroll(QWidget* content, QWidget* parent = nullptr);

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void fitContent();
};

} // namespace posewire::gui
