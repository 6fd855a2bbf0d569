/// What is wrong with the files of DDS Security, and how it is said.
#include "bus/security_check.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "bus/security_error.hpp"
#include "support/process.hpp"
#include "support/security_folder.hpp"

namespace gyrod::bus::test {
namespace {

namespace fs = std::filesystem;
using gyrod::testing::SecurityFolder;
using std::chrono::hours;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::chrono::sys_seconds now() { return std::chrono::floor<seconds>(std::chrono::system_clock::now()); }

/// What is said of a folder; empty if all is well.
std::string trouble_of(const std::string& folder, KeyOwner owner = KeyOwner::kThisUser) {
  try {
    (void)check_security(security_files(folder), now(), owner);
  } catch (const SecurityError& error) {
    return error.what();
  }
  return "";
}

class SecurityCheckTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { made_ = std::make_unique<SecurityFolder>(); }
  static void TearDownTestSuite() { made_.reset(); }

  /// A program's folder that this test may change.
  static std::string own_folder(const std::string& program = "gyrod") {
    static int copies = 0;
    return made_->copy(program, "copy" + std::to_string(++copies));
  }

  static std::unique_ptr<SecurityFolder> made_;
};
std::unique_ptr<SecurityFolder> SecurityCheckTest::made_;

TEST_F(SecurityCheckTest, WhatTheScriptMakesIsAcceptedAndSaysWhoAndUntilWhen) {
  for (const std::string program : {"gyrod", "sensor", "reader"}) {
    const Identity identity = check_security(security_files(made_->of(program)), now());
    EXPECT_EQ(identity.subject, "CN=" + program + ",O=gyrod TEST");
    EXPECT_EQ(identity.expiring_file, made_->of(program) + "/cert.pem") << "the authority's holds ten years";
    // The script's default.
    EXPECT_LT(std::chrono::abs(identity.expires_at - now() - hours(24 * 365)), hours(1));
  }
}

TEST_F(SecurityCheckTest, EveryMissingFileIsNamed) {
  const std::string said = trouble_of("/no/such/folder");
  EXPECT_THAT(said, HasSubstr("'/no/such/folder': cannot read"));
  for (const std::string file : {"identity_ca.cert.pem", "cert.pem", "key.pem", "permissions_ca.cert.pem",
                                 "governance.p7s", "permissions.p7s"})
    EXPECT_THAT(said, HasSubstr(" " + file + " (No such file or directory)"));
}

TEST_F(SecurityCheckTest, AKeyThatOthersMayReadIsRefusedWithItsMode) {
  const std::string folder = own_folder();
  const std::string key = folder + "/key.pem";
  for (const auto& [mode, text] :
       {std::pair(0640, "0640"), std::pair(0604, "0604"), std::pair(0660, "0660")}) {
    chmod(key.c_str(), static_cast<mode_t>(mode));
    EXPECT_THAT(trouble_of(folder),
                AllOf(HasSubstr("'" + key + "'"), HasSubstr(text), HasSubstr("expected 0600 or 0400")));
  }
  chmod(key.c_str(), 0400);
  EXPECT_EQ(trouble_of(folder), "");
}

TEST_F(SecurityCheckTest, AKeyOfAnotherUserIsRefusedUnlessTheCheckIsForThatUser) {
  const std::string folder = own_folder();
  if (chown((folder + "/key.pem").c_str(), 12345, 12345) != 0)
    GTEST_SKIP() << "only root may give files away";
  EXPECT_THAT(trouble_of(folder), AllOf(HasSubstr("key.pem"), HasSubstr("belongs to user 12345"),
                                        HasSubstr("runs as user 0"), HasSubstr("LoadCredential")));
  EXPECT_EQ(trouble_of(folder, KeyOwner::kAnyUser), "");
}

TEST_F(SecurityCheckTest, AKeyFromSystemdMayShowTheMaskOfItsAccessList) {
  const std::string folder = own_folder();
  chmod((folder + "/key.pem").c_str(), 0440);
  EXPECT_NE(trouble_of(folder), "");
  setenv("CREDENTIALS_DIRECTORY", folder.c_str(), 1);
  EXPECT_EQ(trouble_of(folder), "");
  chmod((folder + "/key.pem").c_str(), 0444);
  EXPECT_THAT(trouble_of(folder), HasSubstr("0444"));
  unsetenv("CREDENTIALS_DIRECTORY");
}

TEST_F(SecurityCheckTest, AFileThatAnybodyMayChangeIsRefused) {
  const std::string folder = own_folder();
  chmod((folder + "/permissions_ca.cert.pem").c_str(), 0666);
  EXPECT_THAT(trouble_of(folder),
              AllOf(HasSubstr("permissions_ca.cert.pem"), HasSubstr("anybody may change it")));
}

TEST_F(SecurityCheckTest, AnExpiredCertificateIsNamedWithItsEnd) {
  const std::string folder = own_folder();
  const auto end = now() - seconds(60);
  made_->reissue(folder, -hours(48), -seconds(60));
  const std::string said = trouble_of(folder);
  EXPECT_THAT(said, AllOf(HasSubstr("'" + folder + "/cert.pem'"), HasSubstr("CN=gyrod,O=gyrod TEST"),
                          HasSubstr("expired at "), HasSubstr("renew it")));
  // The minute may have moved on in between.
  EXPECT_THAT(said, HasSubstr("expired at 20"));
  EXPECT_LT(end, now());
}

TEST_F(SecurityCheckTest, ACertificateOfTomorrowIsNamedAndTheClockDoubted) {
  const std::string folder = own_folder();
  made_->reissue(folder, hours(24), hours(48));
  EXPECT_THAT(trouble_of(folder),
              AllOf(HasSubstr("cert.pem"), HasSubstr("holds only from"), HasSubstr("clock")));
}

TEST_F(SecurityCheckTest, ACertificateOfAnotherAuthorityIsRefusedAndBothAreNamed) {
  const SecurityFolder other;
  const std::string folder = own_folder();
  for (const std::string file : {"cert.pem", "key.pem"})
    fs::copy_file(other.of("gyrod/") + file, fs::path(folder) / file, fs::copy_options::overwrite_existing);
  EXPECT_THAT(trouble_of(folder),
              AllOf(HasSubstr("cert.pem"), HasSubstr("is not signed by"), HasSubstr("identity_ca.cert.pem")));
}

TEST_F(SecurityCheckTest, AKeyOfAnotherCertificateIsRefused) {
  const std::string folder = own_folder();
  fs::copy_file(made_->of("reader/key.pem"), folder + "/key.pem", fs::copy_options::overwrite_existing);
  EXPECT_THAT(trouble_of(folder),
              AllOf(HasSubstr("key.pem"), HasSubstr("does not belong to the certificate of 'CN=gyrod")));
}

TEST_F(SecurityCheckTest, AKeyBehindAPassphraseIsRefused) {
  const std::string folder = own_folder();
  gyrod::testing::Process openssl({"/usr/bin/openssl", "pkey", "-aes256", "-passout", "pass:secret", "-in",
                                   made_->of("gyrod/key.pem"), "-out", folder + "/key.pem"},
                                  folder, "pkey");
  ASSERT_EQ(openssl.wait(), 0) << openssl.err();
  EXPECT_THAT(trouble_of(folder), AllOf(HasSubstr("key.pem"), HasSubstr("without a passphrase")));
}

TEST_F(SecurityCheckTest, AChangedDocumentIsRefused) {
  for (const std::string file : {"governance.p7s", "permissions.p7s"}) {
    const std::string folder = own_folder();
    std::ifstream in(folder + "/" + file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text.replace(text.find("<domains>"), 9, "<domains >");
    std::ofstream(folder + "/" + file) << text;
    EXPECT_THAT(trouble_of(folder),
                AllOf(HasSubstr(file), HasSubstr("signature does not hold"), HasSubstr("permissions_ca")));
  }
}

TEST_F(SecurityCheckTest, AnUnsignedDocumentIsRefused) {
  const std::string folder = own_folder();
  std::ofstream(folder + "/governance.p7s") << "<dds/>\n";
  EXPECT_THAT(trouble_of(folder), AllOf(HasSubstr("governance.p7s"), HasSubstr("no signed document")));
}

TEST_F(SecurityCheckTest, PermissionsOfSomebodyElseAreRefusedAndBothSubjectsAreNamed) {
  const std::string folder = own_folder();
  fs::copy_file(made_->of("reader/permissions.p7s"), folder + "/permissions.p7s",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(trouble_of(folder),
              AllOf(HasSubstr("permissions.p7s"), HasSubstr("a grant for 'CN=reader,O=gyrod TEST'"),
                    HasSubstr("<subject_name>CN=gyrod,O=gyrod TEST</subject_name>")));
}

TEST_F(SecurityCheckTest, TheOrderOfANamesPartsDoesNotMatter) {
  const std::string folder = own_folder();
  made_->sign("<dds><subject_name> O=gyrod TEST , CN=gyrod </subject_name></dds>",
              folder + "/permissions.p7s");
  EXPECT_EQ(trouble_of(folder), "");
}

TEST_F(SecurityCheckTest, TheScriptKeepsKeysUnlessForcedAndNeverLetsOthersReadThem) {
  const SecurityFolder made;
  const auto text_of = [&](const std::string& file) {
    std::ifstream in(made.path(file));
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string key = text_of("gyrod/key.pem");
  const std::string certificate = text_of("gyrod/cert.pem");
  made.make({"--program", "gyrod=daemon"});
  EXPECT_EQ(text_of("gyrod/key.pem"), key);
  EXPECT_EQ(text_of("gyrod/cert.pem"), certificate);
  made.make({"--program", "gyrod=daemon", "--renew", "--days", "7"});
  EXPECT_EQ(text_of("gyrod/key.pem"), key);
  EXPECT_NE(text_of("gyrod/cert.pem"), certificate);
  EXPECT_LT(check_security(security_files(made.of("gyrod")), now()).expires_at, now() + hours(24 * 8));
  made.make({"--program", "gyrod=daemon", "--force"});
  EXPECT_NE(text_of("gyrod/key.pem"), key);
  EXPECT_EQ(trouble_of(made.of("gyrod")), "");
  for (const auto& entry : fs::recursive_directory_iterator(made.path(""))) {
    EXPECT_EQ(fs::status(entry).permissions() & (fs::perms::group_all | fs::perms::others_all),
              fs::perms::none)
        << entry.path();
  }
}

}  // namespace
}  // namespace gyrod::bus::test
