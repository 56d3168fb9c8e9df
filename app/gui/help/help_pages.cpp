// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/help/help_pages.h"

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTextDocument>

#include <algorithm>
#include <ranges>
#include <utility>

namespace posewire::gui {

namespace {

constexpr QLatin1String kFolder(":/help/");
constexpr QLatin1String kSuffix(".md");

QString contentOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

QString plainOf(const QString& markdown) {
    QTextDocument document;
    document.setMarkdown(markdown);
    QString text = document.toPlainText();
    text.remove(QChar::ObjectReplacementCharacter); // pictures
    return text;
}

/// Words that begin so, whatever their case.
QRegularExpression beginning(const QString& word) {
    return QRegularExpression(QStringLiteral("(?<![\\w])") + QRegularExpression::escape(word),
                              QRegularExpression::CaseInsensitiveOption |
                                  QRegularExpression::UseUnicodePropertiesOption);
}

qsizetype headingsWith(const QString& markdown, const QRegularExpression& word) {
    const QStringList lines = markdown.split(u'\n');
    return std::ranges::count_if(
        lines, [&](const QString& line) { return line.startsWith(u'#') && line.contains(word); });
}

/// 0 if the page does not have the word.
double weightOf(const HelpPage& page, const QRegularExpression& word) {
    constexpr double kTitle = 20;
    constexpr double kHeading = 6;
    constexpr qsizetype kMostCounted = 5;
    const qsizetype places = page.text.count(word);
    return (page.title.contains(word) ? kTitle : 0) +
           kHeading * static_cast<double>(headingsWith(page.markdown, word)) +
           static_cast<double>(std::min(places, kMostCounted));
}

/// The line of the first place, cut to what a list shows.
QString excerptOf(const HelpPage& page, const QRegularExpression& word) {
    constexpr qsizetype kBefore = 30;
    constexpr qsizetype kMost = 110;
    const qsizetype bodyFrom = page.text.indexOf(u'\n') + 1;
    qsizetype at = page.text.indexOf(word, bodyFrom);
    at = std::max<qsizetype>(at, 0);
    const qsizetype line = page.text.lastIndexOf(u'\n', at) + 1;
    qsizetype from = std::max(line, at - kBefore);
    if (from > line) {
        from = page.text.indexOf(u' ', from) + 1; // whole words
    }
    qsizetype to = page.text.indexOf(u'\n', from);
    to = to < 0 ? page.text.size() : to;
    QString excerpt = page.text.mid(from, std::min(to - from, kMost));
    excerpt = (from > line ? QStringLiteral("… ") : QString()) + excerpt;
    return to - from > kMost ? excerpt.section(u' ', 0, -2) + QStringLiteral(" …") : excerpt;
}

} // namespace

HelpPages::HelpPages(const QMap<QString, QString>& made) {
    const QStringList files = QDir(kFolder).entryList({u'*' + kSuffix}, QDir::Files, QDir::Name);
    for (const QString& file : files) {
        QString markdown = contentOf(kFolder + file);
        for (auto part = made.begin(); part != made.end(); ++part) {
            markdown.replace(u'{' + part.key() + u'}', part.value());
        }
        const QString title = markdown.section(u'\n', 0, 0).mid(2).trimmed();
        m_pages.push_back({file.chopped(kSuffix.size()), title, markdown, plainOf(markdown)});
    }
    readChapters();
}

const HelpPage* HelpPages::find(const QString& id) const {
    const auto found = std::ranges::find(m_pages, id, &HelpPage::id);
    return found == m_pages.end() ? nullptr : &*found;
}

void HelpPages::readChapters() {
    static const QRegularExpression link(QStringLiteral("^[-0-9]+\\.? \\[[^]]*\\]\\(([a-z0-9-]+)\\.md\\)"));
    const HelpPage* start = find(QLatin1String(kStart));
    for (const QString& line : start != nullptr ? start->markdown.split(u'\n') : QStringList()) {
        if (line.startsWith(QLatin1String("## "))) {
            m_chapters.push_back({line.mid(3), {}});
        }
        const auto match = link.match(line);
        const HelpPage* page = match.hasMatch() ? find(match.captured(1)) : nullptr;
        if (page != nullptr && !m_chapters.empty()) {
            m_chapters.back().pages.push_back(page);
        }
    }
    std::erase_if(m_chapters, [](const HelpChapter& chapter) { return chapter.pages.empty(); });
}

std::vector<HelpHit> HelpPages::search(const QString& words) const {
    constexpr double kWholeTitle = 30;
    std::vector<QRegularExpression> wanted;
    std::ranges::transform(searchedWords(words), std::back_inserter(wanted), beginning);
    std::vector<std::pair<double, HelpHit>> found;
    for (const HelpPage& page : m_pages) {
        double weight = wanted.empty() ? 0 : 1;
        double sum = page.title.compare(words.trimmed(), Qt::CaseInsensitive) == 0 ? kWholeTitle : 0;
        for (const QRegularExpression& word : wanted) {
            const double one = weightOf(page, word);
            weight = one == 0 ? 0 : weight;
            sum += one;
        }
        if (weight != 0) {
            found.push_back({sum, {&page, excerptOf(page, wanted.front())}});
        }
    }
    std::ranges::stable_sort(found, std::ranges::greater(), &std::pair<double, HelpHit>::first);
    std::vector<HelpHit> hits;
    std::ranges::copy(std::views::values(found), std::back_inserter(hits));
    return hits;
}

QStringList searchedWords(const QString& line) {
    static const QRegularExpression space(QStringLiteral("[\\s\"]+"));
    return line.toLower().split(space, Qt::SkipEmptyParts);
}

QString placeOfLink(const QString& link, const QString& page) {
    const QString file = link.section(u'#', 0, 0);
    const QString anchor = link.section(u'#', 1);
    const bool isHere = file.isEmpty();
    if (!isHere && !(file.endsWith(kSuffix) && !file.contains(u'/') && !file.contains(u':'))) {
        return {};
    }
    const QString id = isHere ? page : file.chopped(kSuffix.size());
    return anchor.isEmpty() ? id : id + u'#' + anchor;
}

} // namespace posewire::gui
