// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/opening.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/verdict_bar.h"

#include <QDir>
#include <QDropEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QStatusBar>
#include <QUrl>

namespace posewire::gui {

Opening::Opening(MainWindow& window)
    : QObject(&window),
      m_window(window),
      m_stop(
          framedButton(tr("Stop"), tr("Stop opening the file (Esc); what was read of it stays"), &window)) {
    m_stop->setObjectName(QStringLiteral("stopOpeningButton"));
    connect(m_stop, &QToolButton::clicked, window.menus().action("stopOpening"), &QAction::trigger);
    window.statusBar()->addPermanentWidget(m_stop);
    window.setAcceptDrops(true);
    window.installEventFilter(this);
    connect(&window.driver(), &SessionDriver::tableTick, this, &Opening::showState);
    const Files& files = window.driver().files();
    connect(&files, &Files::opened, this, [this](bool isRead, const QString& text) {
        showState();
        // What there is to know of one that was read is told as long as it shows.
        if (isRead) {
            m_window.say(m_sayAgain);
        } else {
            m_window.say(text, HelpTopic::OpeningFailed);
        }
    });
    connect(&window.driver().files().comparing(), &Comparing::changed, this, [this](const QString& text) {
        showState();
        if (!text.isEmpty()) {
            sayAlsoAfterwards(text);
        }
    });
    OwnCharacters& characters = window.viewport().choice().ownCharacters();
    connect(&characters, &OwnCharacters::failed, this, &Opening::sayAlsoAfterwards);
    auto* again = framedButton(tr("Read it again"),
                               tr("Read the files of own characters again that could not be read"), &window);
    again->setObjectName(QStringLiteral("readAgainButton"));
    const auto offerAgain = [again, &characters] {
        again->setVisible(characters.hasFailed() && !characters.isRestoring());
    };
    connect(&characters, &OwnCharacters::failed, again, offerAgain);
    connect(&characters, &OwnCharacters::changed, again, offerAgain);
    connect(again, &QToolButton::clicked, &characters, &OwnCharacters::readAgain);
    window.statusBar()->addPermanentWidget(again);
    offerAgain();
    showState();
}

void Opening::open(const QString& path) {
    noteRecent(path);
    m_window.driver().files().open(path);
}

void Opening::compareWith(const QString& path) {
    m_window.driver().files().comparing().open(path);
    m_window.docks().show(QStringLiteral("compare"));
}

void Opening::noteRecent(const QString& path) {
    QStringList& recent = m_window.kept().recentFiles;
    const QString whole = QDir().absoluteFilePath(path);
    recent.removeAll(whole);
    recent.prepend(whole);
    recent = recent.mid(0, Settings::kMostRecentFiles);
}

QString Opening::folder() const {
    const Settings& kept = m_window.kept();
    const QString newest =
        kept.recentFiles.isEmpty() ? QString() : QFileInfo(kept.recentFiles.first()).absolutePath();
    return !newest.isEmpty() && QDir(newest).exists() ? newest : recordingFolder(kept.recording);
}

bool Opening::eventFilter(QObject* /*window*/, QEvent* event) {
    if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop) {
        return false;
    }
    auto* drop = static_cast<QDropEvent*>(event);
    const QList<QUrl> urls = drop->mimeData()->urls();
    const QString path = urls.size() == 1 ? urls.first().toLocalFile() : QString();
    if (QFileInfo(path).isFile()) { // of this computer
        drop->acceptProposedAction();
        if (event->type() == QEvent::Drop) {
            open(path);
        }
    }
    return true;
}

bool Opening::tellRecovery(const QString& take) {
    const std::vector<log::LostHistory> lost = m_window.driver().history().lost();
    // Its file may have the name of one before.
    const QString newest = lost.empty() ? QString() : QString::number(log::nanosecondsOf(lost.back().end));
    QStringList lines;
    if (!lost.empty() && newest != m_window.kept().recovered) {
        lines += tr("Posewire did not end as it should: packets until %1 are recovered.")
                     .arg(timeOfDay(lost.back().end).chopped(4));
    }
    if (const QFileInfo file(take); !take.isEmpty() && file.exists()) {
        lines += tr("%1 was cut off, and is whole up to then.").arg(file.fileName());
        noteRecent(take);
    }
    auto* bar = m_window.findChild<VerdictBar*>();
    bar->showRecovery(lines.join(QLatin1Char(' ')));
    connect(bar, &VerdictBar::recoveryDismissed, this, [this, newest] {
        m_window.kept().recovered = newest;
        m_window.kept().take.clear();
    });
    return !lines.isEmpty();
}

void Opening::sayAlsoAfterwards(const QString& text) {
    m_window.say(text);
    m_sayAgain = text;
}

void Opening::showState() {
    const bool isOpening = m_window.driver().files().isOpening();
    if (!m_saysOpening && m_window.message() != m_sayAgain) {
        m_sayAgain.clear(); // it has passed
    }
    if (isOpening) {
        m_window.say(m_window.driver().files().openingText());
    } else if (m_saysOpening) {
        m_window.say(m_sayAgain);
    }
    m_saysOpening = isOpening;
    m_window.menus().action("stopOpening")->setEnabled(isOpening); // else Escape is for others
    m_stop->setVisible(isOpening);
}

} // namespace posewire::gui
