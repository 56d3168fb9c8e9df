// SPDX-License-Identifier: GPL-3.0-or-later
// Which files the window opens, records and sends.
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/motion_export_dialog.h"
#include "app/gui/window/own_character_dialog.h"
#include "app/gui/window/pictures_dialog.h"
#include "app/gui/window/recording_dialog.h"
#include "app/gui/window/recovery_dialog.h"
#include "app/gui/window/replay_dialog.h"
#include "core/model/session/roster.h"

#include <QDir>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QToolButton>
#include <QUrl>

namespace posewire::gui {

namespace {

constexpr int kLongestPath = 480; // logical pixels

QString recordingFilters() {
    return MainWindow::tr("Recordings (*.pcapng *.pcap);;All files (*)");
}

/// The file of this computer that is dragged; empty for none and for several.
QString droppedFile(const QMimeData& data) {
    const QList<QUrl> urls = data.urls();
    const QString path = urls.size() == 1 ? urls.first().toLocalFile() : QString();
    return QFileInfo(path).isFile() ? path : QString();
}

} // namespace

void MainWindow::openFile() {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("Open a recording"), placeOfRecordings(), recordingFilters());
    if (!path.isEmpty()) {
        openPath(path);
    }
}

void MainWindow::openPath(const QString& path) {
    noteRecent(path);
    m_driver.files().open(path);
}

void MainWindow::noteRecent(const QString& path) {
    const QString whole = QDir().absoluteFilePath(path);
    m_settings.recentFiles.removeAll(whole);
    m_settings.recentFiles.prepend(whole);
    m_settings.recentFiles = m_settings.recentFiles.mid(0, Settings::kMostRecentFiles);
}

/// Where a recording is looked for: beside the newest, else where takes go.
QString MainWindow::placeOfRecordings() const {
    const QString newest = m_settings.recentFiles.isEmpty()
                               ? QString()
                               : QFileInfo(m_settings.recentFiles.first()).absolutePath();
    return !newest.isEmpty() && QDir(newest).exists() ? newest : recordingFolder(m_settings.recording);
}

void MainWindow::chooseComparison() {
    const QString path = QFileDialog::getOpenFileName(this, tr("Compare with a recording"),
                                                      placeOfRecordings(), recordingFilters());
    if (!path.isEmpty()) {
        compareWith(path);
    }
}

void MainWindow::compareWith(const QString& path) {
    m_driver.files().comparing().open(path);
    showDock(QStringLiteral("compare"));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (!droppedFile(*event->mimeData()).isEmpty()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event) {
    if (const QString path = droppedFile(*event->mimeData()); !path.isEmpty()) {
        event->acceptProposedAction();
        openPath(path);
    }
}

void MainWindow::listRecentFiles(QMenu& menu) {
    for (const QString& path : m_settings.recentFiles) {
        const QString name = QDir::toNativeSeparators(path).replace(u'&', QStringLiteral("&&"));
        menu.addAction(fontMetrics().elidedText(name, Qt::ElideMiddle, kLongestPath), this,
                       [this, path] { openPath(path); });
    }
    menu.addSeparator();
    QAction* clear = m_menus.action("clearRecentFiles");
    clear->setEnabled(!m_settings.recentFiles.isEmpty());
    menu.addAction(clear);
}

void MainWindow::toggleRecording() {
    Takes& takes = m_driver.takes();
    const std::optional<TakeState> take = takes.state();
    if (const QString problem = takes.toggle(m_settings.recording); !problem.isEmpty()) {
        MessageBox box(tr("Record"), problem, QMessageBox::Ok, this);
        offerHelp(box, placeOf(HelpTopic::RecordingFailed));
        box.exec();
    } else if (take && !takes.isRecording()) {
        noteRecent(take->path);
        const QFileInfo file(take->path);
        say(tr("Recorded %1, under File > Open recent: %2, in %3")
                .arg(duration(take->seconds), file.fileName(),
                     QDir::toNativeSeparators(file.absolutePath())));
    }
}

void MainWindow::editRecording() {
    RecordingDialog dialog(m_settings.recording, this);
    if (dialog.exec() == QDialog::Accepted) {
        m_settings.recording = dialog.choice();
    }
}

void MainWindow::showReplay() {
    auto* dialog = findChild<ReplayDialog*>();
    if (dialog == nullptr) {
        dialog = new ReplayDialog(m_driver.replaying(), m_driver.commands(), this);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
    }
    dialog->show();
    dialog->raise();
    dialog->activateWindow();
}

void MainWindow::exportMotion() {
    model::SessionView& session = m_driver.commands().session();
    if (session.atNow().roster().listed().empty()) {
        say(tr("There is no motion to export: no character has arrived yet."), HelpTopic::NothingToExport);
        return;
    }
    MotionExportDialog(session, this).exec(); // the file stays open meanwhile
}

void MainWindow::exportPictures() {
    if (m_driver.commands().session().atNow().roster().listed().empty()) {
        say(tr("There is nothing to draw: no character has arrived yet."), HelpTopic::NothingToExport);
        return;
    }
    PicturesDialog(m_driver.commands(), m_driver.playback(), m_driver.files().comparing().state(),
                   *m_viewport, this)
        .exec();
}

void MainWindow::editOwnCharacter() {
    model::SessionView& session = m_driver.commands().session();
    QStringList names;
    for (const model::Character* character : session.roster().listed()) {
        names += shown(session.roster().displayName(character->key));
    }
    names.removeDuplicates();
    const std::optional<model::CharacterKey>& selected = session.choices().selection.character;
    const QString name = selected ? shown(session.roster().displayName(*selected)) : QString();
    OwnCharacterDialog(m_viewport->choice().ownCharacters(), names, name, this).exec();
}

void MainWindow::showRecovered() {
    auto* dialog = new RecoveryDialog(m_driver.history(), this);
    connect(dialog, &RecoveryDialog::openRequested, this,
            [this](const QString& path) { m_driver.files().open(path); }); // it goes: no recent file
    connect(dialog, &RecoveryDialog::over, this, [this, dialog](const QString& text) {
        if (!text.isEmpty()) {
            say(text);
        }
        dialog->deleteLater();
    });
    dialog->show();
}

void MainWindow::offerRecovered() {
    if (!m_driver.history().lost().empty()) {
        showRecovered();
    }
}

void MainWindow::showOpening() {
    const bool isOpening = m_driver.files().isOpening();
    if (!m_saysOpening && m_health->said() != m_sayAgain) {
        m_sayAgain.clear(); // it has passed
    }
    if (isOpening) {
        say(m_driver.files().openingText());
    } else if (m_saysOpening) {
        say(m_sayAgain);
    }
    m_saysOpening = isOpening;
    m_menus.action("stopOpening")->setEnabled(isOpening); // else Escape is for others
    m_stopOpening->setVisible(isOpening);
}

} // namespace posewire::gui
