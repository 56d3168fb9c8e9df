// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPointer>
#include <QWidget>

#include <vector>

class QFrame;
class QLabel;
class QPushButton;

namespace posewire::gui {

/// One part of the window, and what a newcomer is told about it.
struct TourStep {
    QString title;
    QString text;
    QPointer<QWidget> part;
};

/// Lies over the window, leaves one part after the other clear, and says on a card what it is for. Ends after
/// the last step, with Skip or with Escape, and deletes itself.
class Tour final : public QWidget {
    Q_OBJECT

public:
    /// Raised when a tour has changed so much that those who saw the one before should see it.
    static constexpr int kVersion = 1;

    /// There is at least one step.
    Tour(std::vector<TourStep> steps, QWidget* window);

    void goTo(std::size_t step);
    [[nodiscard]] std::size_t step() const { return m_step; }
    [[nodiscard]] QFrame& card() const { return *m_card; }

signals:
    void ended();

protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* window, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    bool focusNextPrevChild(bool isNext) override;

private:
    void makeCard();
    void restyle();
    void end();
    void next();
    /// Puts the card beside the part that it is about.
    void place();
    [[nodiscard]] QRect part() const;

    std::vector<TourStep> m_steps;
    std::size_t m_step = 0;
    QPointer<QWidget> m_focusBefore;
    QFrame* m_card;
    QLabel* m_title;
    QLabel* m_text;
    QLabel* m_count;
    QPushButton* m_skip;
    QPushButton* m_back;
    QPushButton* m_next;
};

} // namespace posewire::gui
