// SPDX-License-Identifier: GPL-3.0-or-later
// The QApplication of a test program: without a display, in English, the dark theme and UTC.
#include "app/gui/theme/language.h"
#include "app/gui/theme/theme.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QFile>
#include <QTemporaryDir>

#include <memory>

namespace {

class ApplicationEnvironment : public testing::Environment {
public:
    void SetUp() override {
        qputenv("QT_QPA_PLATFORM", "offscreen");
        qputenv("TZ", "UTC");
        qputenv("POSEWIRE_IMPORT", POSEWIRE_IMPORT_PROGRAM);
        qputenv("XDG_CACHE_HOME", QFile::encodeName(m_cache.path()));
        static int argumentCount = 1;
        static char name[] = "test";
        static char* arguments[] = {name, nullptr};
        m_application = std::make_unique<QApplication>(argumentCount, arguments);
        posewire::gui::useLanguage("en");
        posewire::gui::applyTheme(*m_application, posewire::gui::ThemeChoice::Dark);
    }
    void TearDown() override { m_application.reset(); }

private:
    QTemporaryDir m_cache; ///< nothing of another run is in it
    std::unique_ptr<QApplication> m_application;
};

[[maybe_unused]] const auto* const kEnvironment =
    testing::AddGlobalTestEnvironment(new ApplicationEnvironment);

} // namespace
