// SPDX-License-Identifier: GPL-3.0-or-later
// The guide against the program: whatever it names exists, and whatever leads into it arrives.
#include "app/cli/command.h"
#include "app/gui/base/help_topics.h"
#include "app/gui/base/options.h"
#include "app/gui/help/help_pages.h"
#include "app/gui/models/incident_words.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/panels/panels.h"
#include "app/gui/window/guide.h"
#include "app/gui/window/menus.h"
#include "app/usage/usage.h"
#include "core/export/protocol_reference.h"
#include "core/filter/filter.h"
#include "core/log/packet_log.h"
#include "core/model/incidents/incident.h"
#include "core/model/session/session.h"

#include <QDir>
#include <QFile>
#include <QImage>
#include <QKeySequence>
#include <QRegularExpression>
#include <QSet>

#include <gtest/gtest.h>

#include <algorithm>

namespace posewire::gui {
namespace {

const HelpPages& guide() {
    static const HelpPages pages(madeHelpParts());
    return pages;
}

QSet<QString> anchorsOf(const HelpPage& page) {
    QSet<QString> anchors;
    static const QRegularExpression heading(QStringLiteral("^#+ (.*)$"), QRegularExpression::MultilineOption);
    for (auto matches = heading.globalMatch(page.markdown); matches.hasNext();) {
        const std::string title = matches.next().captured(1).toStdString();
        anchors.insert(QString::fromStdString(exporting::headingAnchor(title)));
    }
    return anchors;
}

testing::AssertionResult exists(const QString& place) {
    const HelpPage* page = guide().find(place.section(u'#', 0, 0));
    if (page == nullptr) {
        return testing::AssertionFailure() << "there is no page for " << place.toStdString();
    }
    const QString anchor = place.section(u'#', 1);
    if (!anchor.isEmpty() && !anchorsOf(*page).contains(anchor)) {
        return testing::AssertionFailure() << "there is no heading for " << place.toStdString();
    }
    return testing::AssertionSuccess();
}

/// What a pattern captures on all pages, with the page.
std::vector<std::pair<QString, QString>> allOf(const QString& pattern) {
    std::vector<std::pair<QString, QString>> found;
    const QRegularExpression expression(pattern);
    for (const HelpPage& page : guide().all()) {
        for (auto matches = expression.globalMatch(page.markdown); matches.hasNext();) {
            found.emplace_back(page.id, matches.next().captured(1));
        }
    }
    return found;
}

QString plain(const char* words) {
    return QString::fromUtf8(words).remove(u'&');
}

TEST(Guide, HasAPageForEachDock) {
    for (const PanelInfo& panel : panelTable()) {
        const HelpPage* page = guide().find(QLatin1String(panel.id));
        ASSERT_NE(page, nullptr) << panel.id << ": resources/help needs a page of that name";
        EXPECT_EQ(page->title, QLatin1String(panel.title));
    }
}

TEST(Guide, EveryTopicLeadsToAHeading) {
    for (std::size_t i = 0; i < kHelpTopics.size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(kHelpTopics[i].topic), i);
        EXPECT_TRUE(exists(QLatin1String(kHelpTopics[i].place)));
    }
}

TEST(Guide, ExplainsEveryKindOfIncidentAndEveryCause) {
    for (const model::IncidentKindFacts& kind : model::kIncidentKindTable) {
        EXPECT_TRUE(exists(helpPlaceOf({.kind = kind.kind}))) << kind.name;
    }
    for (std::size_t i = 0; i < model::kLossCauses; ++i) {
        EXPECT_TRUE(exists(helpPlaceOf({.kind = model::IncidentKind::Loss, .cause = model::LossCause(i)})));
    }
}

TEST(Guide, TheContentsListEveryPageOnce) {
    QStringList listed;
    for (const HelpChapter& chapter : guide().chapters()) {
        for (const HelpPage* page : chapter.pages) {
            listed += page->id;
        }
    }
    for (const HelpPage& page : guide().all()) {
        EXPECT_EQ(listed.count(page.id), page.id == HelpPages::kStart ? 0 : 1) << page.id.toStdString();
        EXPECT_TRUE(page.markdown.startsWith("# ")) << page.id.toStdString();
    }
}

TEST(Guide, EveryLinkLeadsToAHeading) {
    const auto links = allOf(QStringLiteral("(?<!!)\\[[^]]*\\]\\(([^)]*)\\)"));
    EXPECT_GT(links.size(), 50U);
    for (const auto& [page, link] : links) {
        if (!link.startsWith("pictures/")) {
            const QString place = placeOfLink(link, page);
            EXPECT_FALSE(place.isEmpty())
                << page.toStdString() << " leads out of the guide: " << link.toStdString();
            EXPECT_TRUE(exists(place)) << page.toStdString();
        }
    }
}

TEST(Guide, EveryPictureIsThereAndSaysInWordsWhatItShows) {
    QSet<QString> shown;
    for (const auto& [page, link] : allOf(QStringLiteral("!\\[[^]]{10,}\\]\\(([^)]*)\\)"))) {
        EXPECT_FALSE(QImage(":/help/" + link).isNull()) << page.toStdString() << ": " << link.toStdString();
        shown.insert(link);
    }
    EXPECT_EQ(allOf(QStringLiteral("(!\\[)")).size(), allOf(QStringLiteral("(!\\[[^]]{10,}\\])")).size());
    qint64 bytes = 0;
    const QDir folder(":/help/pictures");
    for (const QString& name : folder.entryList(QDir::Files)) {
        EXPECT_TRUE(shown.contains("pictures/" + name)) << name.toStdString() << " is on no page";
        bytes += QFile(folder.filePath(name)).size();
    }
    EXPECT_LT(bytes, 2'000'000);
}

TEST(Guide, EveryKeyThatItNamesDoesSomething) {
    // In a terminal, in the fields of the window, and of the guide's own window.
    QStringList known{"Ctrl+C", "Esc", "Tab", "Enter", "Escape"};
    for (const MenuEntry& entry : menuEntries()) {
        known += QString::fromLatin1(entry.action->shortcut);
    }
    const auto keys =
        allOf(QStringLiteral("(?<![\\w+])((?:(?:Ctrl|Shift|Alt)\\+)+(?:F\\d+|Space|Left|Right|Home|"
                             "End|[A-Z0-9]|[,.])(?!\\w)|F\\d+(?!\\w))"));
    EXPECT_GT(keys.size(), 40U);
    for (const auto& [page, key] : keys) {
        EXPECT_TRUE(known.contains(key)) << page.toStdString() << " names " << key.toStdString();
    }
}

TEST(Guide, EveryMenuEntryThatItNamesExists) {
    QStringList menus;
    QStringList known;
    for (const MenuEntry& entry : menuEntries()) {
        const QString path = plain(entry.action->menu).replace(u'/', QStringLiteral(" > "));
        menus += path.section(QStringLiteral(" > "), 0, 0);
        known += path;
        known += path + QStringLiteral(" > ") + plain(entry.action->text).remove(QStringLiteral("…"));
    }
    int count = 0;
    for (const auto& [page, path] : allOf(QStringLiteral("\\*([A-Z][\\w ]+ > [^*]+)\\*"))) {
        if (menus.contains(path.section(QStringLiteral(" > "), 0, 0))) {
            EXPECT_TRUE(known.contains(path)) << page.toStdString() << ": " << path.toStdString();
            ++count;
        }
    }
    EXPECT_GT(count, 20);
}

TEST(Guide, EveryFilterThatItShowsIsOne) {
    const HelpPage* page = guide().find("packets");
    static const QRegularExpression row(QStringLiteral("^\\| `([^`]+)` \\|"),
                                        QRegularExpression::MultilineOption);
    int count = 0;
    for (auto matches = row.globalMatch(page->markdown); matches.hasNext(); ++count) {
        const std::string text = matches.next().captured(1).toStdString();
        EXPECT_TRUE(filter::Filter::compile(text).has_value()) << text;
    }
    EXPECT_GT(count, 4);
}

/// Of a program and of its commands.
QSet<QString> optionsOf(const usage::Program& program) {
    QSet<QString> names;
    const auto add = [&names](const std::vector<usage::Option>& options) {
        for (const usage::Option& option : options) {
            for (const std::string& name : option.names) {
                names.insert(QString::fromStdString(name));
            }
        }
    };
    add(program.options);
    for (const usage::Command& command : program.commands) {
        names.insert(QString::fromStdString(command.name));
        add(command.options);
    }
    return names;
}

TEST(Guide, EveryCommandLineThatItShowsIsOneOfThePrograms) {
    const QSet<QString> window = optionsOf(programUsage());
    const QSet<QString> terminal = optionsOf(cli::Program().line.usage());
    int count = 0;
    for (const auto& [page, line] : allOf(QStringLiteral("`(posewire(?:-cli)?(?: [^`]+)?)`"))) {
        const QStringList words = line.split(u' ');
        const bool isTerminal = words.first() == "posewire-cli";
        const QSet<QString>& known = isTerminal ? terminal : window;
        EXPECT_TRUE(!isTerminal || words.size() == 1 || known.contains(words[1])) << line.toStdString();
        for (const QString& word : words) {
            EXPECT_TRUE(!word.startsWith(u'-') || known.contains(word))
                << page.toStdString() << ": " << line.toStdString();
        }
        ++count;
    }
    EXPECT_GT(count, 10);
}

TEST(Guide, TheTableOfFiguresHasTheTitlesOfTheWindow) {
    log::PacketLog log;
    model::Session session(log);
    const StatisticsModel statistics(session);
    QStringList rows;
    for (int column = kNameColumn + 1; column < kStatisticsColumns; ++column) {
        const QString title = statistics.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
        rows += QStringLiteral("| %1 | ").arg(title);
        EXPECT_TRUE(guide().find("statistics")->markdown.contains(u'\n' + rows.back()))
            << title.toStdString();
        EXPECT_EQ(rows.count(rows.back()), 1) << title.toStdString() << " stands twice";
    }
}

TEST(Guide, HasNoPartLeftThatTheProgramWasToWrite) {
    for (const HelpPage& page : guide().all()) {
        for (const QString& part : madeHelpParts().keys()) {
            EXPECT_FALSE(page.markdown.contains(u'{' + part + u'}')) << page.id.toStdString();
        }
    }
    EXPECT_TRUE(guide().find("shortcuts")->markdown.contains("Ctrl+Shift+P"));
    EXPECT_TRUE(guide().find("statistics")->markdown.contains("RFC 3611"));
}

} // namespace
} // namespace posewire::gui
