// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/help/help_pages.h"

#include <QWidget>

#include <vector>

class QLabel;
class QLineEdit;
class QListWidget;
class QStackedWidget;
class QToolButton;
class QTreeWidget;

namespace posewire::gui {

class MarkdownView;

/// The user guide in a window of its own, beside the one that it is about: contents or what a search found at
/// the left, the page at the right.
class HelpWindow final : public QWidget {
    Q_OBJECT

public:
    /// The pages must outlive the window.
    HelpWindow(const HelpPages& pages, QWidget* parent);

    /// Shows a place, "packets" or "packets#filter", and the window itself; the start page where there is no
    /// such page.
    void open(const QString& place);
    void back() { step(-1); }
    void forward() { step(1); }

    [[nodiscard]] QString place() const;
    [[nodiscard]] MarkdownView& view() const { return *m_view; }
    [[nodiscard]] QTreeWidget& contents() const { return *m_contents; }
    [[nodiscard]] QListWidget& hits() const { return *m_hits; }
    [[nodiscard]] QLineEdit& searchEdit() const { return *m_search; }

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    /// What was looked at, and how far down.
    struct Visit {
        QString place;
        int scroll = -1; ///< -1: at the place itself
    };
    void layOut();
    void addKeys();
    void fillContents();
    void follow(const QUrl& link);
    void visit(const QString& place);
    void step(int by);
    void show(const Visit& visit);
    void showInContents(const QString& page);
    void search(const QString& words);
    /// The best page of a new search; its next place, once that was opened.
    void openBest();
    void openHit(const QString& page);
    void findInPage(bool isBackward);

    const HelpPages& m_pages;
    MarkdownView* m_view;
    QTreeWidget* m_contents;
    QListWidget* m_hits;
    QStackedWidget* m_left;
    QLineEdit* m_search;
    QLabel* m_found;
    QToolButton* m_back;
    QToolButton* m_forward;
    std::vector<Visit> m_visits;
    std::size_t m_current = 0;
    QString m_page; ///< that the view holds
    bool m_isNewSearch = false;
};

} // namespace posewire::gui
