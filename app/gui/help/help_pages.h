// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMap>
#include <QString>
#include <QStringList>

#include <vector>

/// The user guide: the pages of resources/help, which the window shows and packaging/help writes as HTML.
namespace posewire::gui {

struct HelpPage {
    QString id; ///< the file's name without ".md"
    QString title;
    QString markdown;
    QString text; ///< the same as plain text, to be searched
};

struct HelpChapter {
    QString title;
    std::vector<const HelpPage*> pages;
};

struct HelpHit {
    const HelpPage* page;
    QString excerpt; ///< a line around the first place
};

class HelpPages {
public:
    /// The page that the guide begins with. Its lists of links are the contents of the guide.
    static constexpr const char* kStart = "index";

    /// `made`: what the program writes into the pages itself, by the name that stands there between braces.
    explicit HelpPages(const QMap<QString, QString>& made);
    HelpPages(const HelpPages&) = delete;
    HelpPages& operator=(const HelpPages&) = delete;

    /// In the order of their names.
    [[nodiscard]] const std::vector<HelpPage>& all() const { return m_pages; }
    /// Null if there is none.
    [[nodiscard]] const HelpPage* find(const QString& id) const;
    [[nodiscard]] const std::vector<HelpChapter>& chapters() const { return m_chapters; }

    /// Pages with all of these words, or words that begin so, best first: what stands in a title or a
    /// heading counts more.
    [[nodiscard]] std::vector<HelpHit> search(const QString& words) const;

private:
    void readChapters();

    std::vector<HelpPage> m_pages;
    std::vector<HelpChapter> m_chapters;
};

/// The words of a line, in small letters.
[[nodiscard]] QStringList searchedWords(const QString& line);

/// "packets#filter" for the link "packets.md#filter" on any page, "page#filter" for "#filter" on `page`;
/// empty if a link leads out of the guide.
[[nodiscard]] QString placeOfLink(const QString& link, const QString& page);

} // namespace posewire::gui
