// SPDX-License-Identifier: GPL-3.0-or-later
#include "packaging/help/help_html.h"

#include "app/gui/help/help_pages.h"
#include "core/export/protocol_reference.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>

#include <md4c-html.h>

namespace posewire::gui {

namespace {

constexpr const char* kFrame = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>@title</title>
<link rel="stylesheet" href="guide.css"/>
</head>
<body>
<nav aria-label="Contents">
<form role="search" id="search" hidden="hidden"><input type="search" id="words" aria-label="Search the guide" placeholder="Search the guide"/></form>
<ul id="hits" hidden="hidden"></ul>
<div id="contents">
@contents</div>
</nav>
<main>
@body</main>
<script src="pages.js"></script>
<script src="guide.js"></script>
</body>
</html>
)";

QString escaped(const QString& text) {
    return text.toHtmlEscaped();
}

/// "packets.html#filter" for "packets.md#filter"; what leads out of the guide stays.
QString htmlLink(const QString& link, const QString& page) {
    const QString place = placeOfLink(link, page);
    if (place.isEmpty()) {
        return link;
    }
    const QString anchor = place.section(u'#', 1);
    return place.section(u'#', 0, 0) + QStringLiteral(".html") +
           (anchor.isEmpty() ? QString() : u'#' + anchor);
}

/// Replaces each match by what is made of it.
template <class Make>
QString replaced(const QString& text, const QRegularExpression& pattern, Make&& make) {
    QString out;
    qsizetype from = 0;
    for (auto matches = pattern.globalMatch(text); matches.hasNext();) {
        const QRegularExpressionMatch match = matches.next();
        out += text.mid(from, match.capturedStart() - from) + make(match);
        from = match.capturedEnd();
    }
    return out + text.mid(from);
}

QString bodyOf(const HelpPage& page) {
    const QByteArray markdown = page.markdown.toUtf8();
    QByteArray html;
    md_html(
        markdown.constData(), static_cast<MD_SIZE>(markdown.size()),
        [](const MD_CHAR* text, MD_SIZE size, void* into) {
            static_cast<QByteArray*>(into)->append(text, static_cast<qsizetype>(size));
        },
        &html, MD_DIALECT_GITHUB | MD_FLAG_NOHTML, MD_HTML_FLAG_XHTML);
    static const QRegularExpression heading(QStringLiteral("<h([1-6])>(.*?)</h[1-6]>"));
    static const QRegularExpression tag(QStringLiteral("<[^>]*>"));
    static const QRegularExpression link(QStringLiteral("<a href=\"([^\"]*)\""));
    QString body = replaced(QString::fromUtf8(html), heading, [](const QRegularExpressionMatch& match) {
        const std::string words = match.captured(2).remove(tag).toStdString();
        return QStringLiteral("<h%1 id=\"%2\">%3</h%1>")
            .arg(match.captured(1), QString::fromStdString(exporting::headingAnchor(words)),
                 match.captured(2));
    });
    return replaced(body, link, [&page](const QRegularExpressionMatch& match) {
        return QStringLiteral("<a href=\"%1\"").arg(htmlLink(match.captured(1), page.id));
    });
}

QString contentsOf(const HelpPages& pages, const HelpPage& shown) {
    QString html = QStringLiteral("<p><a href=\"%1.html\">%2</a></p>\n")
                       .arg(QLatin1String(HelpPages::kStart),
                            escaped(pages.find(QLatin1String(HelpPages::kStart))->title));
    for (const HelpChapter& chapter : pages.chapters()) {
        html += QStringLiteral("<h2>%1</h2>\n<ul>\n").arg(escaped(chapter.title));
        for (const HelpPage* page : chapter.pages) {
            const QString here = page == &shown ? QStringLiteral(" aria-current=\"page\"") : QString();
            html += QStringLiteral("<li><a href=\"%1.html\"%2>%3</a></li>\n")
                        .arg(page->id, here, escaped(page->title));
        }
        html += QStringLiteral("</ul>\n");
    }
    return html;
}

} // namespace

QString helpHtml(const HelpPages& pages, const HelpPage& page) {
    QString html = QString::fromUtf8(kFrame);
    const QString guide = pages.find(QLatin1String(HelpPages::kStart))->title;
    const QString title = page.title == guide ? guide : QStringLiteral("%1 – %2").arg(page.title, guide);
    html.replace(QLatin1String("@title"), escaped(title));
    html.replace(QLatin1String("@contents"), contentsOf(pages, page));
    html.replace(QLatin1String("@body"), bodyOf(page));
    return html;
}

QString searchIndex(const HelpPages& pages) {
    QJsonArray all;
    for (const HelpPage& page : pages.all()) {
        all.append(QJsonObject{{"id", page.id}, {"title", page.title}, {"text", page.text}});
    }
    return QStringLiteral("const guide = %1;\n")
        .arg(QString::fromUtf8(QJsonDocument(all).toJson(QJsonDocument::Compact)));
}

} // namespace posewire::gui
