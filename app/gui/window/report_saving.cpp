// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/report_saving.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/incident_words.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/theme/words.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/words/say.h"

#include <QApplication>
#include <QDateTime>
#include <QDesktopServices>
#include <QPushButton>
#include <QUrl>

namespace posewire::gui {

namespace {

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

/// Nothing where it was cancelled.
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

bool wantsToOpen(const QString& path, QWidget* parent) {
    MessageBox question(tr("Save stream report"), tr("The report was saved as %1.").arg(path),
                        QMessageBox::Close, parent);
    const auto* open = question.addButton(tr("&Open it"), QMessageBox::AcceptRole);
    question.exec();
    return question.clickedButton() == open;
}

} // namespace

QString writeStreamReport(model::SessionView& session, const std::optional<model::TimeRange>& range,
                          const QString& path) {
    const auto& format = exporting::formatFor<exporting::ReportSheet>(path.toStdString());
    return saveFile(path, format.write({session, optionsFor(session, range)}));
}

QString saveStreamReport(model::SessionView& session, QWidget* parent) {
    if (session.roster().streams().empty()) {
        return tr("There is nothing to report on: no stream has arrived yet.");
    }
    const auto range = askForRange(session, parent);
    if (!range) {
        return {};
    }
    const QString name =
        QDateTime::currentDateTime().toString(QStringLiteral("'stream-report-'yyyyMMdd-HHmm"));
    const QString path = askWhereToSave(parent, tr("Save stream report"), name + QStringLiteral(".html"),
                                        fileFilters<exporting::ReportSheet>());
    if (path.isEmpty()) {
        return {};
    }
    QApplication::setOverrideCursor(Qt::WaitCursor);
    const QString problem = writeStreamReport(session, *range, path);
    QApplication::restoreOverrideCursor();
    if (!problem.isEmpty()) {
        return problem;
    }
    if (wantsToOpen(path, parent) && !QDesktopServices::openUrl(QUrl::fromLocalFile(path))) {
        return tr("No program on this computer opens %1").arg(path);
    }
    return tr("Saved %1").arg(path);
}

} // namespace posewire::gui
