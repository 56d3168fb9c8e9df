// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/help/markdown_view.h"

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
#include <utility>

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

QTextCursor cursorOf(QTextDocument& document, int from, int length) {
    QTextCursor cursor(&document);
    cursor.setPosition(from);
    cursor.setPosition(from + length, QTextCursor::KeepAnchor);
    return cursor;
}

} // namespace

MarkdownView::MarkdownView(QWidget* parent, QString pictures)
    : QTextBrowser(parent), m_pictures(std::move(pictures)) {
    setFrameShape(QFrame::NoFrame);
    setOpenLinks(false);
    new EventWatch(this, QEvent::PaletteChange, [this] {
        applyColours();
        highlight(m_highlighted);
    });
}

void MarkdownView::showText(const QString& markdown) {
    m_highlighted.clear();
    setExtraSelections({});
    setMarkdown(markdown);
    readHeadings();
    applyColours();
    m_fittedWidth = 0;
    fitPictures();
}

void MarkdownView::readHeadings() {
    m_headings.clear();
    for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
        if (const int level = block.blockFormat().headingLevel(); level != 0) {
            m_headings.push_back(
                {block.text(), QString::fromStdString(exporting::headingAnchor(block.text().toStdString())),
                 level, block.position()});
        }
    }
}

void MarkdownView::applyColours() {
    QTextDocument& text = *document();
    QTextCursor cursor(&text);
    cursor.beginEditBlock();
    styleTables(text);
    for (const Heading& heading : m_headings) {
        QTextBlockFormat format;
        format.setTopMargin(heading.position == 0 ? 0 : fontMetrics().height());
        format.setBottomMargin(fontMetrics().height() / 3.0);
        cursorOf(text, heading.position, 0).mergeBlockFormat(format);
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
    if (type != QTextDocument::ImageResource || m_pictures.isEmpty()) {
        return QTextBrowser::loadResource(type, name);
    }
    const QImage picture(m_pictures + name.path());
    const int room = viewport()->width() - static_cast<int>(2 * document()->documentMargin());
    const qreal ratio = devicePixelRatioF();
    const int width = static_cast<int>(std::clamp(room, 1, std::max(1, picture.width())) * ratio);
    QPixmap fitted = QPixmap::fromImage(picture.scaledToWidth(width, Qt::SmoothTransformation));
    fitted.setDevicePixelRatio(ratio);
    return fitted;
}

void MarkdownView::fitPictures() {
    if (m_pictures.isEmpty() || m_fittedWidth == viewport()->width()) {
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

bool MarkdownView::goTo(const QString& anchor) {
    const auto heading = std::ranges::find(m_headings, anchor, &Heading::anchor);
    if (heading == m_headings.end()) {
        return false;
    }
    showPlace(heading->position);
    return true;
}

void MarkdownView::showPlace(int position) {
    const QRectF block = document()->documentLayout()->blockBoundingRect(document()->findBlock(position));
    verticalScrollBar()->setValue(static_cast<int>(block.top()));
    setTextCursor(cursorOf(*document(), position, 0));
    verticalScrollBar()->setValue(static_cast<int>(block.top()));
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

qsizetype MarkdownView::countOf(const QString& words) const {
    return words.isEmpty() ? 0 : document()->toPlainText().count(words, Qt::CaseInsensitive);
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
