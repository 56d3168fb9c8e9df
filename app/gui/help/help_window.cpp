// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/help/help_window.h"

#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "core/export/protocol_reference.h"

#include <QAbstractTextDocumentLayout>
#include <QKeyEvent>
#include <QPixmap>
#include <QRegularExpression>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
#include <QTextBlock>
#include <QTextDocument>
#include <QTextTable>
#include <QToolButton>

#include <algorithm>
#include <vector>

namespace posewire::gui {

namespace {

/// Gives Markdown's tables, which come with raised white borders, the look of the theme.
void styleTables(QTextDocument& document) {
    constexpr qreal kPadding = 4;
    for (QTextFrame* frame : document.rootFrame()->childFrames()) {
        auto* table = qobject_cast<QTextTable*>(frame);
        if (table == nullptr) {
            continue;
        }
        QTextTableFormat format = table->format();
        format.setBorderStyle(QTextFrameFormat::BorderStyle_Solid);
        format.setBorderBrush(theme().line);
        format.setBorder(1);
        format.setBorderCollapse(true);
        format.setCellPadding(kPadding);
        format.setCellSpacing(0);
        table->setFormat(format);
        for (int column = 0; column < table->columns(); ++column) {
            QTextTableCell cell = table->cellAt(0, column);
            QTextCharFormat header = cell.format();
            header.setBackground(theme().raised);
            header.setForeground(theme().dim);
            cell.setFormat(header);
        }
    }
    // Else headings behind tables keep the height that they had while these were changed: none.
    document.markContentsDirty(0, document.characterCount());
}

template <class Visit>
void eachFragment(const QTextDocument& document, Visit&& visit) {
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        for (auto at = block.begin(); !at.atEnd(); ++at) {
            visit(at.fragment());
        }
    }
}

/// True if links lead to this block by this anchor.
bool isHeading(const QTextBlock& block, const QString& anchor) {
    return block.blockFormat().headingLevel() != 0 &&
           exporting::headingAnchor(block.text().toStdString()) == anchor.toStdString();
}

QTextCursor cursorOf(QTextDocument& document, int from, int length) {
    QTextCursor cursor(&document);
    cursor.setPosition(from);
    cursor.setPosition(from + length, QTextCursor::KeepAnchor);
    return cursor;
}

constexpr int kPageRole = Qt::UserRole;

QToolButton* barButton(const QString& sign, const QString& name, QWidget* parent) {
    QToolButton* button = framedButton(sign, name, parent);
    button->setAccessibleName(name);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

} // namespace

MarkdownView::MarkdownView(const HelpPages& pages, QWidget* parent) : QTextBrowser(parent), m_pages(pages) {
    setFrameShape(QFrame::NoFrame);
    setOpenLinks(false);
    connect(this, &QTextBrowser::sourceChanged, this, &MarkdownView::arrive);
    new EventWatch(this, QEvent::PaletteChange, [this] {
        applyColours();
        highlight(m_highlighted);
    });
}

/// A step back restores the scroll bar after this.
void MarkdownView::arrive(const QUrl& place) {
    if (document()->pageSize().width() <= 0) { // loadResource() has loaded it, perhaps once more
        highlight({});
        applyColours();
        setLineWrapColumnOrWidth(lineWrapColumnOrWidth()); // gives it its width again
        m_fittedWidth = 0;
        fitPictures();
    }
    QTextBlock block = place.hasFragment() ? document()->begin() : QTextBlock();
    while (block.isValid() && !isHeading(block, place.fragment())) {
        block = block.next();
    }
    const int position = block.isValid() ? block.position() : 0;
    const QRectF area = document()->documentLayout()->blockBoundingRect(document()->findBlock(position));
    const int top = position == 0 ? 0 : static_cast<int>(area.top()); // the title keeps its margin
    verticalScrollBar()->setValue(top);
    setTextCursor(cursorOf(*document(), position, 0));
    verticalScrollBar()->setValue(top);
}

void MarkdownView::applyColours() {
    QTextDocument& text = *document();
    QTextCursor cursor(&text);
    cursor.beginEditBlock();
    styleTables(text);
    for (QTextBlock block = text.begin(); block.isValid(); block = block.next()) {
        if (block.blockFormat().headingLevel() != 0) {
            QTextBlockFormat format;
            format.setTopMargin(block.position() == 0 ? 0 : fontMetrics().height());
            format.setBottomMargin(fontMetrics().height() / 3.0);
            QTextCursor(block).mergeBlockFormat(format);
        }
    }
    std::vector<QTextFragment> links;
    eachFragment(text, [&links](const QTextFragment& fragment) {
        if (fragment.charFormat().isAnchor()) {
            links.push_back(fragment);
        }
    });
    for (const QTextFragment& link : links) {
        QTextCharFormat format;
        format.setForeground(theme().accent);
        format.setFontUnderline(false);
        cursorOf(text, link.position(), link.length()).mergeCharFormat(format);
    }
    cursor.endEditBlock();
}

QVariant MarkdownView::loadResource(int type, const QUrl& name) {
    if (type != QTextDocument::ImageResource) {
        // Without a width the page is not laid out while it grows cell by cell, which takes seconds for a
        // long one: arrive() does that once.
        document()->setPageSize({0, 0});
        const HelpPage* page = m_pages.find(name.path());
        return page != nullptr ? QVariant(page->markdown) : QVariant();
    }
    const QImage picture(QStringLiteral(":/help/") + name.path());
    const int room = viewport()->width() - static_cast<int>(2 * document()->documentMargin());
    const qreal ratio = devicePixelRatioF();
    const int width = static_cast<int>(std::clamp(room, 1, std::max(1, picture.width())) * ratio);
    QPixmap fitted = QPixmap::fromImage(picture.scaledToWidth(width, Qt::SmoothTransformation));
    fitted.setDevicePixelRatio(ratio);
    return fitted;
}

void MarkdownView::fitPictures() {
    if (m_fittedWidth == viewport()->width()) {
        return;
    }
    m_fittedWidth = viewport()->width();
    bool hasPictures = false;
    eachFragment(*document(), [&](const QTextFragment& fragment) {
        if (fragment.charFormat().isImageFormat()) {
            const QUrl name(fragment.charFormat().toImageFormat().name());
            document()->addResource(QTextDocument::ImageResource, name,
                                    loadResource(QTextDocument::ImageResource, name));
            hasPictures = true;
        }
    });
    if (hasPictures) {
        document()->markContentsDirty(0, document()->characterCount());
    }
}

void MarkdownView::resizeEvent(QResizeEvent* event) {
    QTextBrowser::resizeEvent(event);
    fitPictures();
}

bool MarkdownView::findAgain(const QString& words, bool isBackward) {
    if (words.isEmpty()) {
        return false;
    }
    const auto flags = isBackward ? QTextDocument::FindBackward : QTextDocument::FindFlags();
    if (find(words, flags)) {
        return true;
    }
    const QTextCursor before = textCursor();
    moveCursor(isBackward ? QTextCursor::End : QTextCursor::Start);
    const bool isFound = find(words, flags);
    if (!isFound) {
        setTextCursor(before);
    }
    return isFound;
}

void MarkdownView::highlight(const QStringList& words) {
    m_highlighted = words;
    QList<ExtraSelection> selections;
    for (const QString& word : words) {
        const QRegularExpression pattern(QStringLiteral("\\b") + QRegularExpression::escape(word),
                                         QRegularExpression::CaseInsensitiveOption |
                                             QRegularExpression::UseUnicodePropertiesOption);
        for (QTextCursor at = document()->find(pattern); !at.isNull(); at = document()->find(pattern, at)) {
            ExtraSelection selection;
            selection.cursor = at;
            selection.format.setBackground(theme().selection);
            selections += selection;
        }
    }
    setExtraSelections(selections);
}

HelpWindow::HelpWindow(const HelpPages& pages, QWidget* parent)
    : QWidget(parent, Qt::Window), m_pages(pages), m_view(new MarkdownView(pages, this)) {
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
            m_isNewSearch = false;
            visit(item->data(kPageRole).toString());
            findInPage(false);
        }
    };
    connect(m_hits, &QListWidget::currentItemChanged, this, openRow);
    connect(m_hits, &QListWidget::itemClicked, this, openRow);
    connect(m_view, &QTextBrowser::anchorClicked, this, &HelpWindow::follow);
    connect(m_view, &QTextBrowser::sourceChanged, this, &HelpWindow::followView);
    connect(m_search, &QLineEdit::textChanged, this, &HelpWindow::search);
    connect(m_search, &QLineEdit::returnPressed, this, &HelpWindow::openBest);
}

void HelpWindow::layOut() {
    auto* back = barButton(QStringLiteral("←"), tr("Back (Alt+Left)"), this);
    auto* forward = barButton(QStringLiteral("→"), tr("Forward (Alt+Right)"), this);
    auto* start = barButton(tr("Start"), tr("First page of the guide (Alt+Home)"), this);
    for (QToolButton* button : {back, forward}) {
        button->setEnabled(false);
    }
    connect(m_view, &QTextBrowser::backwardAvailable, back, &QWidget::setEnabled);
    connect(m_view, &QTextBrowser::forwardAvailable, forward, &QWidget::setEnabled);
    connect(back, &QToolButton::clicked, m_view, &QTextBrowser::backward);
    connect(forward, &QToolButton::clicked, m_view, &QTextBrowser::forward);
    connect(start, &QToolButton::clicked, this, [this] { visit(QLatin1String(HelpPages::kStart)); });
    const QFontMetrics metrics = fontMetrics();
    m_search->setMinimumWidth(metrics.averageCharWidth() * 20);
    m_search->setMaximumWidth(metrics.averageCharWidth() * 44);
    auto* bar = spacedRow({10, 8, 10, 8}, 6);
    for (QWidget* part : std::initializer_list<QWidget*>{back, forward, start}) {
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
    onKey(QKeySequence(Qt::ALT | Qt::Key_Left), [this] { m_view->backward(); });
    onKey(QKeySequence(Qt::ALT | Qt::Key_Right), [this] { m_view->forward(); });
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

void HelpWindow::follow(const QUrl& link) {
    const bool isResolved = link.path() == page().id; // the view resolves "#filter" to "packets#filter"
    const QString place = isResolved ? link.toString() : placeOfLink(link.toString(), page().id);
    if (!place.isEmpty()) {
        visit(place);
    }
}

void HelpWindow::visit(const QString& place) {
    const bool isKnown = m_pages.find(place.section(u'#', 0, 0)) != nullptr;
    m_view->setSource(isKnown ? place : QString::fromLatin1(HelpPages::kStart),
                      QTextDocument::MarkdownResource);
}

/// The view's own source is that of before until this returns.
void HelpWindow::followView(const QUrl& place) {
    const HelpPage& page = *m_pages.find(place.path());
    m_view->highlight(searchedWords(m_search->text()));
    setWindowTitle(page.id == QLatin1String(HelpPages::kStart)
                       ? page.title
                       : tr("%1 – Posewire user guide").arg(page.title));
    const QSignalBlocker quiet(m_contents);
    m_contents->setCurrentItem(nullptr);
    for (QTreeWidgetItemIterator at(m_contents); *at != nullptr; ++at) {
        if ((*at)->data(0, kPageRole).toString() == page.id) {
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
                                               : tr("%n pages", nullptr, count));
    m_view->highlight(searchedWords(words));
}

void HelpWindow::openBest() {
    if (m_isNewSearch && m_hits->count() != 0) {
        m_hits->setCurrentRow(0); // which opens it
    } else {
        findInPage(false);
    }
}

/// Shows the next place of what is searched for; first the best page, where the one that is open has none.
void HelpWindow::findInPage(bool isBackward) {
    const QStringList words = searchedWords(m_search->text());
    if (words.isEmpty()) {
        return;
    }
    const bool isListed = std::ranges::any_of(m_pages.search(m_search->text()),
                                              [&](const HelpHit& hit) { return hit.page == &page(); });
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
