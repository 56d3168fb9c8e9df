// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/health_bar.h"
#include "app/gui/window/opening.h"
#include "tests/app/gui/window/main_window_fixture.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QToolButton>

#include <sys/stat.h>

/// Which files the window opens and records.
namespace posewire::gui {
namespace {

TEST_F(MainWindowTest, EscapeStopsOpeningAFileAndIsForOthersElse) {
    const auto window = makeWindow();
    auto* stop = window->findChild<QToolButton*>("stopOpeningButton");
    EXPECT_TRUE(stop->isHidden());
    EXPECT_FALSE(action(*window, "stopOpening")->isEnabled());
    const QString endless = folder.filePath("endless");
    ASSERT_EQ(::mkfifo(QFile::encodeName(endless).constData(), 0600), 0);
    driver.files().open(endless);
    emit driver.tableTick();
    EXPECT_FALSE(stop->isHidden());
    QTest::keyClick(window.get(), Qt::Key_Escape);
    EXPECT_FALSE(driver.files().isOpening());
    EXPECT_TRUE(stop->isHidden());
    EXPECT_TRUE(window->findChild<HealthBar*>("healthBar")
                    ->findChild<QLabel*>("message")
                    ->text()
                    .startsWith("Opening endless was stopped"));
}

TEST_F(MainWindowTest, TellsAtEachStartOfATakeThatWasCutOffUntilThatIsDismissed) {
    Settings settings;
    settings.take = folder.filePath("take.pcapng");
    ASSERT_TRUE(QFile(settings.take).open(QIODevice::WriteOnly));
    const auto window = makeWindow(settings);
    EXPECT_TRUE(window->opening().tellRecovery(settings.take));
    EXPECT_EQ(window->settings().take, settings.take);
    action(*window, "recovered")->trigger();
    EXPECT_EQ(window->settings().take, QString());
    EXPECT_FALSE(window->opening().tellRecovery({}));
}

TEST_F(MainWindowTest, SaysWhatIsWrongWithACharacterAlsoWhereAFileIsOpenedMeanwhile) {
    const auto window = makeWindow();
    const auto* message = window->findChild<HealthBar*>("healthBar")->findChild<QLabel*>("message");
    const QString problem = "The mannequin stays";
    emit window->viewport().choice().ownCharacters().failed(problem);
    emit driver.files().opened(true, "");
    EXPECT_EQ(message->text(), problem);
    const QString endless = folder.filePath("endless");
    ASSERT_EQ(::mkfifo(QFile::encodeName(endless).constData(), 0600), 0);
    driver.files().open(endless);
    emit driver.tableTick();
    EXPECT_TRUE(message->text().startsWith("Opening endless"));
    driver.files().cancelOpening();
    window->say("Saved");
    emit driver.tableTick();
    emit driver.tableTick();
    emit driver.files().opened(true, "");
    EXPECT_EQ(message->text(), "") << "it has been said";
}

TEST_F(MainWindowTest, ReadsACharacterAgainOnRequest) {
    const auto window = makeWindow();
    auto* again = window->findChild<QToolButton*>("readAgainButton");
    EXPECT_TRUE(again->isHidden());
    OwnCharacters& characters = window->viewport().choice().ownCharacters();
    const auto wait = [&] { return QTest::qWaitFor([&] { return !characters.isRestoring(); }, 20'000); };
    const QString path = folder.filePath("own.glb");
    characters.restoreState({QJsonObject{{"character", ""}, {"file", path}}});
    ASSERT_TRUE(wait());
    EXPECT_FALSE(again->isHidden());
    ASSERT_TRUE(QFile::copy(
        QString::fromStdString(posewire::test::sourcePath("resources/mannequin_low.glb").string()), path));
    again->click();
    ASSERT_TRUE(wait());
    EXPECT_TRUE(again->isHidden());
    EXPECT_NE(characters.wardrobe().of("Alice"), nullptr);
}

TEST_F(MainWindowTest, SaysWhyNothingIsComparedAlsoWhenARecordingIsShownThen) {
    const auto window = makeWindow();
    emit driver.files().comparing().changed("Nothing to compare with: it is empty");
    emit driver.files().opened(true, {});
    const auto* message = window->findChild<HealthBar*>("healthBar")->findChild<QLabel*>("message");
    EXPECT_FALSE(message->isHidden());
    EXPECT_EQ(message->text(), "Nothing to compare with: it is empty");
}

TEST_F(MainWindowTest, SaysWhyNothingIsComparedOnceARecordingIsOpen) {
    const auto window = makeWindow();
    const auto fileWith = [this](const char* name, const std::vector<std::byte>& bytes) {
        QFile made(folder.filePath(name));
        EXPECT_TRUE(made.open(QIODevice::WriteOnly));
        made.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
        return made.fileName();
    };
    driver.files().open(fileWith("take.mxtp", posewire::test::golden("02_quaternion_counted").bytes));
    driver.files().comparing().open(fileWith("empty.mxtp", {}));
    EXPECT_TRUE(QTest::qWaitFor([this] {
        driver.tick();
        emit driver.tableTick();
        return !driver.files().isOpening() && driver.commands().isFileShown();
    }));
    emit driver.tableTick();
    const QString said = window->message();
    EXPECT_TRUE(said.startsWith("Nothing to compare with: ")) << qPrintable(said);
}

TEST_F(MainWindowTest, SaysWhereATakeIsAndOffersToOpenIt) {
    Settings settings;
    settings.recording.folder = folder.path();
    const auto window = makeWindow(settings);
    action(*window, "record")->trigger();
    ASSERT_TRUE(driver.takes().isRecording());
    const QString path = driver.takes().state()->path;
    action(*window, "record")->trigger();
    EXPECT_TRUE(QTest::qWaitFor([&] {
        driver.takes().follow({});
        return !window->message().isEmpty();
    }));
    const QString said = window->findChild<HealthBar*>("healthBar")->findChild<QLabel*>("message")->text();
    EXPECT_TRUE(said.contains(QFileInfo(path).fileName()) && said.contains(folder.path()))
        << qPrintable(said);
    window->close();
    QString problem;
    EXPECT_EQ(file.read(&problem).recentFiles, QStringList{path});
}

} // namespace
} // namespace posewire::gui
