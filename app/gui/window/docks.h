// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QDockWidget;
class QLabel;
class QToolButton;

namespace posewire::gui {

class ElidedLabel;

/// The title of a dock: its name, a short summary at the right, "?" that opens its page of the guide, and
/// under the pointer what floats and closes it. An edge shows where the keyboard is.
class DockTitle final : public QWidget {
    Q_OBJECT

public:
    /// The dock has its object name already: the page is called so.
    explicit DockTitle(QDockWidget* dock);

    void setSummary(const QString& summary);
    /// Where a tab says the name, the title does not say it again.
    void setTabbed(bool isTabbed);

    /// QDockWidget makes as much room as is said here, whatever the widget's fixed height.
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void restyle();
    void showButtons(bool isShown);
    [[nodiscard]] bool hasKeyboard() const;

    QLabel* m_title;
    ElidedLabel* m_summary;
    QToolButton* m_help;
    QToolButton* m_float;
    QToolButton* m_close;
};

/// Lets a dock become lower than its content, which then scrolls: the least heights of docks above each other
/// must not add up to more than the screen has.
[[nodiscard]] QWidget* scrolling(QWidget* content, QDockWidget* dock);

} // namespace posewire::gui
