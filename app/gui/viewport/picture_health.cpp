// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/presenter.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <QStringList>

namespace posewire::gui {

namespace {

using render::Simplification;

/// Seconds a picture; where they take longer, movement is not seen as one.
constexpr double kSlow = 0.1;

/// What a step leaves out, beside what those before it do.
QString leftOut(Simplification step) {
    switch (step) {
    case Simplification::LowShadows:
        return tr("coarse shadows");
    case Simplification::SmallShadows:
        return tr("small shadows");
    case Simplification::LowBodies:
        return tr("coarse bodies");
    case Simplification::HardSelfShadows:
        return tr("hard shadows");
    case Simplification::RawEdges:
        return tr("raw edges");
    case Simplification::FewAxes:
        return tr("fewer axes");
    case Simplification::HalfRate:
        return tr("half rate");
    case Simplification::None:
        break;
    }
    return tr("full quality");
}

QString milliseconds(double seconds) {
    return fixed(seconds * 1000, 0);
}

} // namespace

PictureHealth pictureHealthOf(const PictureLoad& load, const QString& hardwareFailure) {
    if (load.budget <= 0) {
        return {tr("by graphics hardware"), tr("The graphics hardware draws; nothing is left out."), false};
    }
    const auto step = static_cast<int>(load.step);
    QString why = hardwareFailure.isEmpty()
                      ? tr("The processor draws the viewport, since there is no graphics hardware for it.")
                      : tr("The processor draws the viewport, since the graphics hardware failed: %1")
                            .arg(hardwareFailure);
    why += QLatin1Char('\n') +
           tr("A picture may take %1 ms, so that receiving and the window have time. Where it takes longer, "
              "what is missed least is left out, step by step, and comes back when there is time. A picture "
              "in which nothing moves is always drawn in full.")
               .arg(milliseconds(load.budget));
    if (step != 0) {
        QStringList all;
        for (int one = 1; one <= step; ++one) {
            all += leftOut(static_cast<Simplification>(one));
        }
        why += QLatin1Char('\n') + tr("Now on step %1 of %2, since a picture took %3 ms: %4.")
                                       .arg(step)
                                       .arg(render::kLastSimplification)
                                       .arg(milliseconds(load.cause), all.join(QStringLiteral(", ")));
    }
    if (load.isStill) {
        return {tr("nothing moves · full quality"), why, false};
    }
    const QString state =
        step == 0
            ? leftOut(load.step)
            : tr("step %1 of %2: %3").arg(step).arg(render::kLastSimplification).arg(leftOut(load.step));
    return {load.typical > 0 ? tr("%1 · %2 ms").arg(state, milliseconds(load.typical)) : state, why,
            load.step >= Simplification::FewAxes || load.typical > kSlow};
}

} // namespace posewire::gui
