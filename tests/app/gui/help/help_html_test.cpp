// SPDX-License-Identifier: GPL-3.0-or-later
#include "packaging/help/help_html.h"

#include "app/gui/window/guide.h"

#include <QFile>
#include <QRegularExpression>
#include <QSet>
#include <QXmlStreamReader>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

/// What a page has and what it refers to.
struct Read {
    QSet<QString> ids;
    QStringList links;
    QStringList pictures;
};

Read read(const QString& html, const QString& page) {
    Read found;
    QXmlStreamReader xml(html);
    while (!xml.atEnd()) {
        xml.readNext();
        if (xml.isStartElement()) {
            const QXmlStreamAttributes attributes = xml.attributes();
            if (attributes.hasAttribute("id")) {
                found.ids.insert(attributes.value("id").toString());
            }
            if (xml.name() == QLatin1String("a")) {
                found.links += attributes.value("href").toString();
            } else if (xml.name() == QLatin1String("img")) {
                EXPECT_FALSE(attributes.value("alt").isEmpty());
                found.pictures += attributes.value("src").toString();
            }
        }
    }
    EXPECT_FALSE(xml.hasError()) << page.toStdString() << ": " << xml.errorString().toStdString()
                                 << " in line " << xml.lineNumber();
    return found;
}

TEST(HelpHtml, EveryPageIsWellFormedAndItsLinksArrive) {
    const HelpPages pages(madeHelpParts());
    QMap<QString, Read> all;
    for (const HelpPage& page : pages.all()) {
        all[page.id + ".html"] = read(helpHtml(pages, page), page.id);
    }
    for (auto page = all.begin(); page != all.end(); ++page) {
        for (const QString& link : page->links) {
            const auto target = all.constFind(link.section(u'#', 0, 0));
            ASSERT_NE(target, all.cend()) << page.key().toStdString() << ": " << link.toStdString();
            const QString anchor = link.section(u'#', 1);
            EXPECT_TRUE(anchor.isEmpty() || target->ids.contains(anchor)) << link.toStdString();
        }
        for (const QString& picture : page->pictures) {
            EXPECT_TRUE(QFile::exists(":/help/" + picture)) << picture.toStdString();
        }
    }
}

TEST(HelpHtml, APageHasItsTitleItsTablesAndAllContents) {
    const HelpPages pages(madeHelpParts());
    const QString html = helpHtml(pages, *pages.find("packets"));
    EXPECT_TRUE(html.contains("<title>Packets – Posewire user guide</title>"));
    EXPECT_TRUE(helpHtml(pages, *pages.find("index")).contains("<title>Posewire user guide</title>"));
    EXPECT_TRUE(html.contains("<h1 id=\"packets\">Packets</h1>"));
    EXPECT_TRUE(html.contains("<h2 id=\"filter\">Filter</h2>"));
    EXPECT_TRUE(html.contains("<th>column</th>"));
    EXPECT_TRUE(html.contains("<a href=\"packets.html\" aria-current=\"page\">Packets</a>"));
    for (const HelpPage& page : pages.all()) {
        EXPECT_TRUE(html.contains("<a href=\"" + page.id + ".html\"")) << page.id.toStdString();
    }
}

TEST(HelpHtml, TheSearchKnowsTheTextOfEveryPage) {
    const HelpPages pages(madeHelpParts());
    const QString index = searchIndex(pages);
    EXPECT_TRUE(index.startsWith("const guide = ["));
    EXPECT_EQ(index.count("\"id\":"), static_cast<qsizetype>(pages.all().size()));
    EXPECT_TRUE(index.contains("IGMP snooping"));
}

} // namespace
} // namespace posewire::gui
