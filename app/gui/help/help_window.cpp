// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/help/help_window.h"

#include "app/gui/help/markdown_view.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
#include <QStackedWidget>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kPageRole = Qt::UserRole;

QToolButton* barButton(const QString& sign, const QString& name, QWidget* parent) {
    QToolButton* button = framedButton(sign, name, parent);
    button->setAccessibleName(name);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

} // namespace

HelpWindow::HelpWindow(const HelpPages& pages, QWidget* parent)
    : QWidget(parent, Qt::Window),
      m_pages(pages),
      m_view(new MarkdownView(this, QStringLiteral(":/help/"))),
      m_contents(new QTreeWidget(this)),
      m_hits(new QListWidget(this)),
      m_left(new QStackedWidget(this)),
      m_search(new QLineEdit(this)),
      m_found(plainLabel(this)),
      m_back(barButton(QStringLiteral("←"), tr("Back (Alt+Left)"), this)),
      m_forward(barButton(QStringLiteral("→"), tr("Forward (Alt+Right)"), this)) {
    setObjectName(QStringLiteral("helpWindow"));
    setWindowTitle(tr("Posewire user guide"));
    setAttribute(Qt::WA_StyledBackground);
    m_view->setObjectName(QStringLiteral("helpPage"));
    m_view->setAccessibleName(tr("Page"));
    m_contents->setHeaderHidden(true);
    m_contents->setAccessibleName(tr("Contents"));
    m_contents->setFrameShape(QFrame::NoFrame);
    m_hits->setAccessibleName(tr("Pages found"));
    m_hits->setFrameShape(QFrame::NoFrame);
    m_hits->setWordWrap(true);
    m_hits->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_search->setPlaceholderText(tr("Search the guide"));
    m_search->setAccessibleName(tr("Search the guide"));
    m_search->setClearButtonEnabled(true);
    fillContents();
    layOut();
    addKeys();
    const auto openItem = [this](const QTreeWidgetItem* item) {
        if (item != nullptr && !item->data(0, kPageRole).isNull()) {
            visit(item->data(0, kPageRole).toString());
        }
    };
    connect(m_contents, &QTreeWidget::currentItemChanged, this, openItem);
    connect(m_contents, &QTreeWidget::itemClicked, this, openItem);
    const auto openRow = [this](const QListWidgetItem* item) {
        if (item != nullptr) {
            openHit(item->data(kPageRole).toString());
        }
    };
    connect(m_hits, &QListWidget::currentItemChanged, this, openRow);
    connect(m_hits, &QListWidget::itemClicked, this, openRow);
    connect(m_view, &QTextBrowser::anchorClicked, this, &HelpWindow::follow);
    connect(m_search, &QLineEdit::textChanged, this, &HelpWindow::search);
    connect(m_search, &QLineEdit::returnPressed, this, &HelpWindow::openBest);
}

void HelpWindow::layOut() {
    auto* start = barButton(tr("Start"), tr("First page of the guide (Alt+Home)"), this);
    connect(m_back, &QToolButton::clicked, this, &HelpWindow::back);
    connect(m_forward, &QToolButton::clicked, this, &HelpWindow::forward);
    connect(start, &QToolButton::clicked, this, [this] { visit(QLatin1String(HelpPages::kStart)); });
    const QFontMetrics metrics = fontMetrics();
    m_search->setMinimumWidth(metrics.averageCharWidth() * 20);
    m_search->setMaximumWidth(metrics.averageCharWidth() * 44);
    auto* bar = spacedRow({10, 8, 10, 8}, 6);
    for (QWidget* part : std::initializer_list<QWidget*>{m_back, m_forward, start}) {
        bar->addWidget(part);
    }
    bar->addWidget(m_search, 1);
    bar->addWidget(m_found, 1);
    m_left->addWidget(m_contents);
    m_left->addWidget(m_hits);
    auto* splitter = new QSplitter(this);
    splitter->addWidget(m_left);
    splitter->addWidget(m_view);
    splitter->setStretchFactor(1, 1);
    splitter->setChildrenCollapsible(false);
    m_left->setMinimumWidth(metrics.averageCharWidth() * 22);
    m_contents->ensurePolished();
    const QAbstractItemView& titles = *m_contents;
    const int contents = titles.sizeHintForColumn(0) + m_contents->verticalScrollBar()->sizeHint().width() +
                         2 * metrics.averageCharWidth();
    m_view->setMinimumWidth(metrics.averageCharWidth() * 30);
    splitter->setSizes(
        {std::max(contents, metrics.averageCharWidth() * 38), metrics.averageCharWidth() * 112});
    m_view->document()->setDocumentMargin(metrics.height());
    auto* column = tightColumn(this);
    column->addLayout(bar);
    column->addWidget(new Line(this));
    column->addWidget(splitter, 1);
    resize(metrics.averageCharWidth() * 150, metrics.lineSpacing() * 46);
}

void HelpWindow::addKeys() {
    const auto onKey = [this](const QKeySequence& keys, auto&& action) {
        connect(new QShortcut(keys, this), &QShortcut::activated, this, action);
    };
    onKey(QKeySequence::Find, [this] {
        m_search->setFocus();
        m_search->selectAll();
    });
    onKey(QKeySequence(Qt::Key_F3), [this] { findInPage(false); });
    onKey(QKeySequence(Qt::SHIFT | Qt::Key_F3), [this] { findInPage(true); });
    onKey(QKeySequence(Qt::ALT | Qt::Key_Left), [this] { back(); });
    onKey(QKeySequence(Qt::ALT | Qt::Key_Right), [this] { forward(); });
    onKey(QKeySequence(Qt::ALT | Qt::Key_Home), [this] { visit(QLatin1String(HelpPages::kStart)); });
    onKey(QKeySequence::Close, [this] { close(); });
}

void HelpWindow::fillContents() {
    for (const HelpChapter& chapter : m_pages.chapters()) {
        auto* top = new QTreeWidgetItem(m_contents, {chapter.title});
        top->setFlags(Qt::ItemIsEnabled);
        QFont font = m_contents->font();
        font.setWeight(QFont::DemiBold);
        top->setFont(0, font);
        for (const HelpPage* page : chapter.pages) {
            auto* item = new QTreeWidgetItem(top, {page->title});
            item->setData(0, kPageRole, page->id);
        }
    }
    m_contents->expandAll();
}

/// Escape ends a search, and then the window.
void HelpWindow::keyPressEvent(QKeyEvent* event) {
    if (event->key() != Qt::Key_Escape) {
        QWidget::keyPressEvent(event);
    } else if (m_search->text().isEmpty()) {
        close();
    } else {
        m_search->clear();
    }
}

void HelpWindow::open(const QString& place) {
    QWidget::show();
    raise();
    activateWindow();
    visit(place); // where a heading is depends on the width of the page
    m_view->setFocus();
}

QString HelpWindow::place() const {
    return m_visits.empty() ? QString() : m_visits[m_current].place;
}

void HelpWindow::follow(const QUrl& link) {
    if (const QString place = placeOfLink(link.toString(), m_page); !place.isEmpty()) {
        visit(place);
    }
}

void HelpWindow::visit(const QString& place) {
    const bool isKnown = m_pages.find(place.section(u'#', 0, 0)) != nullptr;
    const QString known = isKnown ? place : QString::fromLatin1(HelpPages::kStart);
    if (!m_visits.empty()) {
        m_visits[m_current].scroll = m_view->verticalScrollBar()->value();
        if (m_visits[m_current].place != known) {
            m_visits.resize(++m_current);
        }
    }
    m_visits.resize(m_current + 1);
    m_visits[m_current] = {known, -1};
    show(m_visits[m_current]);
}

void HelpWindow::step(int by) {
    const auto next = static_cast<std::ptrdiff_t>(m_current) + by;
    if (next >= 0 && next < std::ssize(m_visits)) {
        m_visits[m_current].scroll = m_view->verticalScrollBar()->value();
        m_current = static_cast<std::size_t>(next);
        show(m_visits[m_current]);
    }
}

void HelpWindow::show(const Visit& visit) {
    const HelpPage* page = m_pages.find(visit.place.section(u'#', 0, 0));
    if (page->id != m_page) {
        m_page = page->id;
        m_view->showText(page->markdown);
        m_view->highlight(searchedWords(m_search->text()));
        setWindowTitle(page->id == QLatin1String(HelpPages::kStart)
                           ? page->title
                           : tr("%1 – Posewire user guide").arg(page->title));
    }
    if (visit.scroll >= 0) {
        m_view->verticalScrollBar()->setValue(visit.scroll);
    } else if (!m_view->goTo(visit.place.section(u'#', 1))) {
        m_view->showPlace(0);
    }
    showInContents(page->id);
    m_back->setEnabled(m_current > 0);
    m_forward->setEnabled(m_current + 1 < m_visits.size());
}

void HelpWindow::showInContents(const QString& page) {
    const QSignalBlocker quiet(m_contents);
    m_contents->setCurrentItem(nullptr);
    for (QTreeWidgetItemIterator at(m_contents); *at != nullptr; ++at) {
        if ((*at)->data(0, kPageRole).toString() == page) {
            m_contents->setCurrentItem(*at);
            m_contents->scrollToItem(*at);
        }
    }
}

void HelpWindow::search(const QString& words) {
    const std::vector<HelpHit> hits = m_pages.search(words);
    m_isNewSearch = true;
    const QSignalBlocker quiet(m_hits);
    m_hits->clear();
    const QFontMetrics metrics = m_hits->fontMetrics();
    const int room = m_left->width() - m_hits->verticalScrollBar()->sizeHint().width() - metrics.height();
    for (const HelpHit& hit : hits) {
        auto* item = new QListWidgetItem(hit.page->title + u'\n' + hit.excerpt, m_hits);
        // The list would take a line for each, and cut the excerpt off.
        const QRect lines = metrics.boundingRect(QRect(0, 0, room, 0), Qt::TextWordWrap, item->text());
        item->setSizeHint({0, lines.height() + metrics.height()});
        item->setData(kPageRole, hit.page->id);
        item->setData(Qt::AccessibleTextRole, hit.page->title);
        item->setData(Qt::AccessibleDescriptionRole, hit.excerpt);
    }
    m_left->setCurrentWidget(words.trimmed().isEmpty() ? static_cast<QWidget*>(m_contents) : m_hits);
    const auto count = static_cast<int>(hits.size());
    m_found->setText(words.trimmed().isEmpty() ? QString()
                     : count == 0              ? tr("not found")
                     : count == 1              ? tr("1 page")
                                               : tr("%1 pages").arg(count));
    m_view->highlight(searchedWords(words));
}

void HelpWindow::openBest() {
    if (m_isNewSearch && m_hits->count() != 0) {
        m_hits->setCurrentRow(0); // which opens it
    } else {
        findInPage(false);
    }
}

void HelpWindow::openHit(const QString& page) {
    m_isNewSearch = false;
    visit(page);
    findInPage(false);
}

/// Shows the next place of what is searched for; first the best page, where the one that is open has none.
void HelpWindow::findInPage(bool isBackward) {
    const QStringList words = searchedWords(m_search->text());
    if (words.isEmpty()) {
        return;
    }
    const bool isListed = std::ranges::any_of(m_pages.search(m_search->text()),
                                              [&](const HelpHit& hit) { return hit.page->id == m_page; });
    if (!isListed) {
        if (m_hits->count() != 0) {
            m_hits->setCurrentRow(0); // which finds there
        }
        return;
    }
    if (!m_view->findAgain(m_search->text().trimmed(), isBackward)) {
        m_view->findAgain(words.front(), isBackward);
    }
}

} // namespace posewire::gui
