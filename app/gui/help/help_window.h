// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/help/help_pages.h"
#include "app/gui/theme/widgets.h"

#include <QLineEdit>
#include <QListWidget>
#include <QStackedWidget>
#include <QTextBrowser>
#include <QTreeWidget>
#include <QWidget>

namespace posewire::gui {

class HelpPages;
class MarkdownView;

/// Shows the pages of the guide in the colours of the theme: tables with thin lines, pictures no wider than
/// the view. Its source is a place, "packets" or "packets#filter"; history and steps back are QTextBrowser's.
/// The owner follows the links.
class MarkdownView final : public QTextBrowser {
    Q_OBJECT

public:
    /// The pages must outlive the view.
    MarkdownView(const HelpPages& pages, QWidget* parent);

    /// Selects the next place, or the previous one, that contains the words as they are; begins again at the
    /// other end. False if the page does not contain them.
    bool findAgain(const QString& words, bool isBackward);
    /// Paints all places where one of these words begins; none for no words.
    void highlight(const QStringList& words);

    [[nodiscard]] QVariant loadResource(int type, const QUrl& name) override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void arrive(const QUrl& place);
    void applyColours();
    void fitPictures();

    const HelpPages& m_pages;
    QStringList m_highlighted;
    int m_fittedWidth = 0; ///< of the pictures
};

/// The user guide in a window of its own, beside the one that it is about: contents or what a search found at
/// the left, the page at the right.
class HelpWindow final : public QWidget {
    Q_OBJECT

public:
    /// The pages must outlive the window.
    HelpWindow(const HelpPages& pages, QWidget* parent);

    /// Shows a place, "packets" or "packets#filter", and the window itself; the start page if there is no
    /// such page.
    void open(const QString& place);
    [[nodiscard]] QString place() const { return m_view->source().toString(); }
    [[nodiscard]] MarkdownView& view() const { return *m_view; }
    [[nodiscard]] QTreeWidget& contents() const { return *m_contents; }
    [[nodiscard]] QListWidget& hits() const { return *m_hits; }

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void layOut();
    void addKeys();
    void fillContents();
    void follow(const QUrl& link);
    void visit(const QString& place);
    /// Title, contents and search follow the page that the view shows.
    void followView(const QUrl& place);
    [[nodiscard]] const HelpPage& page() const { return *m_pages.find(m_view->source().path()); }
    void search(const QString& words);
    /// The best page of a new search; its next place, once that was opened.
    void openBest();
    void findInPage(bool isBackward);

    const HelpPages& m_pages;
    MarkdownView* m_view;
    QTreeWidget* m_contents = new QTreeWidget(this);
    QListWidget* m_hits = new QListWidget(this);
    QStackedWidget* m_left = new QStackedWidget(this);
    QLineEdit* m_search = new QLineEdit(this);
    QLabel* m_found = plainLabel(this);
    bool m_isNewSearch = false;
};

} // namespace posewire::gui
