// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/help/markdown_view.h"

#include "app/gui/help/help_pages.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "core/export/protocol_reference.h"

#include <QAbstractTextDocumentLayout>
#include <QPixmap>
#include <QRegularExpression>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextDocument>
#include <QTextTable>

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

/// Whether links lead to this block by this anchor.
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

/// QTextBrowser has loaded the page, unless it was loaded before. A step back then restores its scroll bar.
void MarkdownView::arrive(const QUrl& place) {
    if (place.path() != m_page) {
        m_page = place.path();
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
    showPosition(block.isValid() ? block.position() : 0);
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

void MarkdownView::showPosition(int position) {
    const QRectF block = document()->documentLayout()->blockBoundingRect(document()->findBlock(position));
    const int top = position == 0 ? 0 : static_cast<int>(block.top()); // the title keeps its margin
    verticalScrollBar()->setValue(top);
    setTextCursor(cursorOf(*document(), position, 0));
    verticalScrollBar()->setValue(top);
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

} // namespace posewire::gui
