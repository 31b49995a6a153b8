#include "session/project/person_name.h"

#include <QSettings>
#include <QTest>
#include <array>
#include <memory>

#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::person_name_test {

/// Under which name somebody judges: the one she gave, else that of her account.
class PersonNameTest : public QObject {
    Q_OBJECT

    static constexpr std::array<const char*, 3> kAccount = {"USER", "LOGNAME", "USERNAME"};
    std::unique_ptr<test::OwnHome> home_;
    std::array<QByteArray, 3> account_;

 private slots:
    void initTestCase() {
        for (std::size_t i = 0; i < kAccount.size(); ++i) account_[i] = qgetenv(kAccount[i]);
    }
    void init() {
        home_ = std::make_unique<test::OwnHome>();
        for (const char* variable : kAccount) qunsetenv(variable);
    }
    void cleanup() {
        home_.reset();
        for (std::size_t i = 0; i < kAccount.size(); ++i)
            if (account_[i].isEmpty())
                qunsetenv(kAccount[i]);
            else
                qputenv(kAccount[i], account_[i]);
    }

    void theNameGivenCountsBeforeTheAccounts() {
        QCOMPARE(personName(), QStringLiteral("somebody"));
        qputenv("USERNAME", "third");
        QCOMPARE(personName(), QStringLiteral("third"));
        qputenv("LOGNAME", "second");
        QCOMPARE(personName(), QStringLiteral("second"));
        qputenv("USER", "anna");
        QCOMPARE(personName(), QStringLiteral("anna"));
        setPersonName(QStringLiteral(" Anna  Schmidt\n"));
        QCOMPARE(personName(), QStringLiteral("Anna Schmidt"));
    }

    void withoutANameTheAccountCountsAgain() {
        qputenv("USER", "anna");
        for (const char* none : {"", "  ", "anna"}) {
            setPersonName(QStringLiteral("Anna Schmidt"));
            setPersonName(QLatin1String(none));
            QCOMPARE(personName(), QStringLiteral("anna"));
            qputenv("USER", "berta");
            QCOMPARE(personName(), QStringLiteral("berta"));
            qputenv("USER", "anna");
        }
    }

    void aNameHasAnEnd() {
        setPersonName(QString(10'000, QLatin1Char('a')));
        QCOMPARE(personName().size(), kLongestPersonName);
    }
};

}  // namespace eyrie::ui::person_name_test

EYRIE_UI_TEST(QCoreApplication, person_name_test, PersonNameTest)
#include "person_name_test.moc"
