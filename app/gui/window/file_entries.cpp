// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/menus.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/incident_words.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/help_link.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "app/gui/window/docks.h"
#include "app/gui/window/export_dialogs.h"
#include "app/gui/window/main_window.h"
#include "app/gui/window/opening.h"
#include "app/gui/window/preferences.h"
#include "app/gui/window/recording_dialogs.h"
#include "app/gui/window/save_packets.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/words/say.h"

#include <QApplication>
#include <QDateTime>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QMenu>
#include <QPushButton>
#include <QUrl>

namespace posewire::gui {

namespace {

using Window = MainWindow;
using FileDo = ActionsOf<MainWindow>;

model::SessionView& shownSession(const Window& window) {
    return window.driver().commands().session();
}
Files& filesOf(const Window& window) {
    return window.driver().files();
}
Takes& takesOf(const Window& window) {
    return window.driver().takes();
}

QString askForRecording(Window& window, const QString& title) {
    return QFileDialog::getOpenFileName(&window, title, window.opening().folder(),
                                        tr("Recordings (*.pcapng *.pcap *.mvnx);;All files (*)"));
}

void openFile(Window& window) {
    if (const QString path = askForRecording(window, tr("Open a recording")); !path.isEmpty()) {
        window.opening().open(path);
    }
}

void chooseComparison(Window& window) {
    if (const QString path = askForRecording(window, tr("Compare with a recording")); !path.isEmpty()) {
        window.opening().compareWith(path);
    }
}

void endComparison(Window& window) {
    filesOf(window).comparing().close();
}

void listRecentFiles(Window& window, QMenu& menu) {
    constexpr int kLongestPath = 480; // logical pixels
    for (const QString& path : window.kept().recentFiles) {
        const QString name = QDir::toNativeSeparators(path).replace(u'&', QStringLiteral("&&"));
        menu.addAction(window.fontMetrics().elidedText(name, Qt::ElideMiddle, kLongestPath), &window,
                       [&window, path] { window.opening().open(path); });
    }
    menu.addSeparator();
    QAction* clear = window.menus().action("clearRecentFiles");
    clear->setEnabled(!window.kept().recentFiles.isEmpty());
    menu.addAction(clear);
}

void clearRecentFiles(Window& window) {
    window.kept().recentFiles.clear();
}

void saveScreenshot(Window& window) {
    const QPixmap picture = window.grab();
    const QString path = askWhereToSave(&window, tr("Save screenshot"), QStringLiteral("posewire.png"),
                                        tr("Pictures (*.png)"));
    if (path.isEmpty()) {
        return;
    }
    const QString problem = savePicture(picture, path);
    if (problem.isEmpty()) {
        window.say(tr("Saved %1").arg(path));
    } else {
        window.say(problem, HelpTopic::SavingFailed);
    }
}

exporting::StreamReportOptions optionsFor(model::SessionView& session,
                                          const std::optional<model::TimeRange>& range) {
    exporting::StreamReportOptions options;
    options.application = ("Posewire " + QCoreApplication::applicationVersion()).toStdString();
    options.range = range;
    for (const model::Incident& event : session.verdicts().incidents().all()) {
        const bool isInside = !range || (event.firstStamp < range->to && event.lastStamp >= range->from);
        if (isInside && event.group() == model::IncidentGroup::Limit) {
            options.exceeded.push_back(whoseWords(session, event).toStdString() + ": " +
                                       say(event.fact(), words::Form::Sentence));
        }
    }
    return options;
}

/// Nothing if it was cancelled.
std::optional<std::optional<model::TimeRange>> askForRange(model::SessionView& session, QWidget* parent) {
    const auto range = session.range();
    if (!range) {
        return std::optional<model::TimeRange>();
    }
    MessageBox question(
        tr("Save stream report"),
        tr("A range of time is selected: from %1 to %2.")
            .arg(timeOfDay(session.wallOf(range->from)), timeOfDay(session.wallOf(range->to))),
        QMessageBox::Cancel, parent);
    const auto* selected = question.addButton(tr("&Selected range"), QMessageBox::AcceptRole);
    const auto* all = question.addButton(tr("&All of it"), QMessageBox::AcceptRole);
    question.exec();
    if (question.clickedButton() == selected) {
        return range;
    }
    return question.clickedButton() == all ? std::optional(std::optional<model::TimeRange>()) : std::nullopt;
}

void saveReport(Window& window) {
    model::SessionView& session = shownSession(window);
    if (session.roster().streams().empty()) {
        return window.say(tr("There is nothing to report on: no stream has arrived yet."));
    }
    const auto range = askForRange(session, &window);
    if (!range) {
        return;
    }
    const QString name =
        QDateTime::currentDateTime().toString(QStringLiteral("'stream-report-'yyyyMMdd-HHmm"));
    const QString path = askWhereToSave(&window, tr("Save stream report"), name + QStringLiteral(".html"),
                                        fileFilters<exporting::ReportSheet>());
    if (path.isEmpty()) {
        return;
    }
    QApplication::setOverrideCursor(Qt::WaitCursor);
    const QString problem = writeStreamReport(session, *range, path);
    QApplication::restoreOverrideCursor();
    if (!problem.isEmpty()) {
        return window.say(problem);
    }
    MessageBox question(tr("Save stream report"), tr("The report was saved as %1.").arg(path),
                        QMessageBox::Close, &window);
    const auto* open = question.addButton(tr("&Open it"), QMessageBox::AcceptRole);
    question.exec();
    const bool isDone =
        question.clickedButton() != open || QDesktopServices::openUrl(QUrl::fromLocalFile(path));
    window.say((isDone ? tr("Saved %1") : tr("No program on this computer opens %1")).arg(path));
}

/// Says so if there is nothing to export yet.
bool hasCharacters(Window& window, const QString& otherwise) {
    const bool isAny = !shownSession(window).atNow().roster().listed().empty();
    if (!isAny) {
        window.say(otherwise, HelpTopic::NothingToExport);
    }
    return isAny;
}

void exportMotion(Window& window) {
    if (hasCharacters(window, tr("There is no motion to export: no character has arrived yet."))) {
        MotionExportDialog(shownSession(window), &window).exec(); // the file stays open meanwhile
    }
}

void savePackets(Window& window) {
    if (shownSession(window).end() == 0) {
        window.say(tr("There are no packets to save: nothing has arrived yet."));
        return;
    }
    OpenedFile* const file = filesOf(window).file();
    SavePacketsDialog(shownSession(window), file != nullptr ? file->path() : QString(), &window).exec();
}

void exportPictures(Window& window) {
    if (hasCharacters(window, tr("There is nothing to draw: no character has arrived yet."))) {
        SessionDriver& driver = window.driver();
        showPicturesDialog(driver.commands(), driver.playback(), driver.files().comparing().state(),
                           window.viewport(), &window);
    }
}

void toggleRecording(Window& window) {
    Takes& takes = takesOf(window);
    const std::optional<TakeState> take = takes.state();
    if (const QString problem = takes.toggle(window.kept().recording); !problem.isEmpty()) {
        MessageBox box(tr("Record"), problem, QMessageBox::Ok, &window);
        offerHelp(box, placeOf(HelpTopic::RecordingFailed));
        box.exec();
    } else if (take && !takes.isRecording()) {
        window.opening().noteRecent(take->path);
    }
}

void showReplay(Window& window) {
    auto* dialog = window.findChild<ReplayDialog*>();
    if (dialog == nullptr) {
        dialog = new ReplayDialog(window.driver().replaying(), window.driver().receiving(),
                                  window.driver().commands(), window.kept().replayTarget, &window);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
    }
    dialog->show();
    dialog->raise();
    dialog->activateWindow();
}

void showRecovered(Window& window) {
    auto* dialog = new RecoveryDialog(window.driver().history(), &window);
    QObject::connect(dialog, &RecoveryDialog::openRequested, &window,
                     [&window](const QString& path) { filesOf(window).open(path); }); // it goes: not recent
    QObject::connect(dialog, &RecoveryDialog::over, &window, [&window, dialog](const QString& text) {
        if (!text.isEmpty()) {
            window.say(text);
        }
        dialog->deleteLater();
    });
    dialog->show();
}

const ActionInfo kFileEntries[] = {
    {"open", QT_TRANSLATE_NOOP("Action", "&File"), QT_TRANSLATE_NOOP("Action", "&Open…"), "Ctrl+O",
     FileDo::call<openFile>},
    listIn(QT_TRANSLATE_NOOP("Action", "&File/Open rece&nt"), FileDo::list<listRecentFiles>),
    {"clearRecentFiles", "&File/Open rece&nt", QT_TRANSLATE_NOOP("Action", "&Clear list"), "",
     FileDo::call<clearRecentFiles>},
    {"closeFile", "&File", QT_TRANSLATE_NOOP("Action", "&Close recording"), "Ctrl+W",
     FileDo::callIn<filesOf, &Files::close>},
    {"stopOpening", "&File", QT_TRANSLATE_NOOP("Action", "S&top opening"), "Esc",
     FileDo::callIn<filesOf, &Files::cancelOpening>},
    lineIn("&File"),
    {"compareWith", "&File", QT_TRANSLATE_NOOP("Action", "Compare &with a recording…"), "Ctrl+Shift+O",
     FileDo::call<chooseComparison>},
    {"endComparison", "&File", QT_TRANSLATE_NOOP("Action", "&End comparison"), "",
     FileDo::call<endComparison>},
    lineIn("&File"),
    {"saveScreenshot", "&File", QT_TRANSLATE_NOOP("Action", "&Save screenshot…"), "Ctrl+Shift+S",
     FileDo::call<saveScreenshot>},
    {"saveReport", "&File", QT_TRANSLATE_NOOP("Action", "Save stre&am report…"), "",
     FileDo::call<saveReport>},
    {"savePackets", "&File", QT_TRANSLATE_NOOP("Action", "Save pac&kets…"), "Ctrl+S",
     FileDo::call<savePackets>},
    {"exportMotion", "&File", QT_TRANSLATE_NOOP("Action", "Export &motion…"), "", FileDo::call<exportMotion>},
    {"exportPictures", "&File", QT_TRANSLATE_NOOP("Action", "Export pict&ures…"), "",
     FileDo::call<exportPictures>},
    {kPanelEntries, "&File", "", ""},
    lineIn("&File"),
    {"record", "&File", QT_TRANSLATE_NOOP("Action", "Reco&rd"), "R", FileDo::call<toggleRecording>,
     FileDo::isIn<takesOf, &Takes::isRecording>},
    {"recordingOptions", "&File", QT_TRANSLATE_NOOP("Action", "Recor&ding options…"), "",
     FileDo::call<openPreferences, PreferencesSection::Recording>},
    lineIn("&File"),
    {"replay", "&File", QT_TRANSLATE_NOOP("Action", "Repla&y to the network…"), "", FileDo::call<showReplay>},
    {"recovered", "&File", QT_TRANSLATE_NOOP("Action", "Reco&vered packets…"), "",
     FileDo::call<showRecovered>},
    {"history", "&File", QT_TRANSLATE_NOOP("Action", "&History…"), "",
     FileDo::call<openPreferences, PreferencesSection::History>},
    {"preferences", "&File", QT_TRANSLATE_NOOP("Action", "&Preferences…"), "Ctrl+,",
     FileDo::call<openPreferences, PreferencesSection::Appearance>},
    lineIn("&File"),
    {"quit", "&File", QT_TRANSLATE_NOOP("Action", "&Quit"), "Ctrl+Q", FileDo::call<&Window::close>},
};

} // namespace

QString writeStreamReport(model::SessionView& session, const std::optional<model::TimeRange>& range,
                          const QString& path) {
    const auto& format = exporting::formatFor<exporting::ReportSheet>(path.toStdString());
    return saveFile(path, format.write({session, optionsFor(session, range)}));
}

std::span<const ActionInfo> fileEntries() {
    return kFileEntries;
}

} // namespace posewire::gui
