// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/guide.h"

#include "app/gui/help/help_window.h"
#include "app/gui/models/statistics_model.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/window/main_window.h"
#include "core/export/protocol_reference.h"

#include <QApplication>
#include <QDesktopServices>
#include <QKeySequence>

namespace posewire::gui {

namespace {

QString plainText(const char* words) {
    return QCoreApplication::translate("Action", words).remove(QLatin1Char('&'));
}

QString shortcutsMarkdown() {
    QString text = Guide::tr("| Key | Menu | What it does |\n|---|---|---|\n");
    for (const MenuEntry& entry : menuEntries()) {
        const ActionInfo& info = *entry.action;
        const QKeySequence keys(QLatin1String(info.shortcut), QKeySequence::PortableText);
        if (!keys.isEmpty()) {
            text += QStringLiteral("| %1 | %2 | %3 |\n")
                        .arg(keys.toString(QKeySequence::NativeText),
                             plainText(info.menu).replace(QLatin1Char('/'), QStringLiteral(" > ")),
                             plainText(info.text));
        }
    }
    return text;
}

/// The columns of the statistics, in their order and in the words of their tooltips.
QString figuresMarkdown() {
    QString text = Guide::tr("| Column | What it says |\n|---|---|\n");
    for (int column = kNameColumn + 1; column < kStatisticsColumns; ++column) {
        if (const auto figure = figureIn(column)) {
            const model::FigureRow& row = model::rowOf(*figure);
            text += QStringLiteral("| %1 | %2 |\n")
                        .arg(translatedText(row.shortTitle()), translatedText(row.help));
        } else {
            text += Guide::tr(
                "| Curve | Rate over the range, or over the last two minutes; marked where samples were "
                "lost |\n");
        }
    }
    return text;
}

} // namespace

Guide::Guide(MainWindow& window) : QObject(&window), m_window(window) {
    QDesktopServices::setUrlHandler(QLatin1String(kHelpScheme), this, "follow");
}

Guide::~Guide() {
    QDesktopServices::unsetUrlHandler(QLatin1String(kHelpScheme));
}

void Guide::follow(const QUrl& link) {
    show(link.hasFragment() ? link.path() + u'#' + link.fragment() : link.path());
}

void Guide::show(const QString& place) {
    if (m_pages == nullptr) {
        m_pages = std::make_unique<HelpPages>(madeHelpParts());
    }
    // A dialog that waits for its answer lets only its own windows be used.
    QWidget* parent = QApplication::activeModalWidget();
    parent = parent == nullptr ? &m_window : parent;
    auto* guide = parent->findChild<HelpWindow*>(QString(), Qt::FindDirectChildrenOnly);
    if (guide == nullptr) {
        guide = new HelpWindow(*m_pages, parent);
    }
    guide->open(place);
}

void Guide::offerFirstSteps() {
    if (!m_window.kept().isGuideOffered && m_window.message().isEmpty()) {
        m_window.kept().isGuideOffered = true;
        m_window.say(tr("New here? The guide begins with the first steps: Help > First steps"),
                     HelpTopic::FirstSteps);
    }
}

QMap<QString, QString> madeHelpParts() {
    const QString protocol = QString::fromStdString(exporting::protocolReference());
    return {{QStringLiteral("shortcuts"), shortcutsMarkdown()},
            {QStringLiteral("figures"), figuresMarkdown()},
            {QStringLiteral("protocol"), protocol.section(u'\n', 1).trimmed()}}; // the page has its title
}

} // namespace posewire::gui
