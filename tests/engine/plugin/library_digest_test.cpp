// SPDX-License-Identifier: Apache-2.0
#include "engine/plugin/library_digest.h"

#include <elf.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "engine/base/problem.h"
#include "tests/support/expect_throw_text.h"

namespace {

namespace fs = std::filesystem;
using engine::Digest;
using engine::library_digest;
using engine::read_section;

// Compiles tiny libraries. What they need is linked with a run path relative to them, as plugins are.
class LibraryDigest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("c++ --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs a compiler";
    std::string pattern = (fs::temp_directory_path() / "library_digest_test.XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }

  std::string library(const std::string& name, const std::string& source, const std::string& flags = "") const {
    const std::string path = folder_ + "/lib" + name + ".so";
    std::ofstream(folder_ + "/" + name + ".cpp") << source;
    const std::string command = "cd " + folder_ + " && c++ -O1 -fPIC -shared -ffile-prefix-map=" + folder_ +
                                "=. -Wl,--build-id -o lib" + name + ".so " + name + ".cpp -L. " + flags;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return path;
  }
  Digest digest(const std::string& path) const { return library_digest(path, {}); }
  static std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string written(const std::string& bytes) const {
    const std::string path = folder_ + "/written.so";
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    return path;
  }

  std::string folder_;
};

TEST_F(LibraryDigest, ACommentAndDebuggingInformationKeepIt) {
  const Digest plain = digest(library("toy", "int twice(int x) { return 2 * x; }\n"));
  EXPECT_EQ(digest(library("toy", "// A comment.\nint twice(int x) { return 2 * x; }\n")), plain);
  EXPECT_EQ(digest(library("toy", "int twice(int x) { return 2 * x; }\n", "-g")), plain);
  EXPECT_EQ(digest(library("toy", "// A comment.\n\nint twice(int x) { return 2 * x; }\n", "-g")), plain);
  EXPECT_EQ(digest(library("toy", "int twice(int x) { return 2 * x; }\n", "-s")), plain);
}

TEST_F(LibraryDigest, AChangeOfCodeOrDataAltersIt) {
  const Digest plain = digest(library("toy", "int table[2] = {1, 2}; int twice(int x) { return 2 * x; }\n"));
  EXPECT_NE(digest(library("toy", "int table[2] = {1, 2}; int twice(int x) { return 3 * x; }\n")), plain);
  EXPECT_NE(digest(library("toy", "int table[2] = {1, 3}; int twice(int x) { return 2 * x; }\n")), plain);
}

TEST_F(LibraryDigest, MovingTheFileKeepsIt) {
  const std::string path = library("toy", "int twice(int x) { return 2 * x; }\n");
  const Digest before = digest(path);
  fs::create_directory(folder_ + "/elsewhere");
  fs::rename(path, folder_ + "/elsewhere/other_name.so");
  EXPECT_EQ(digest(folder_ + "/elsewhere/other_name.so"), before);
}

TEST_F(LibraryDigest, ALibraryOfOursThatItNeedsCounts) {
  library("inner", "int inner() { return 1; }\n");
  const std::string source = "int inner(); int outer() { return inner(); }\n";
  const std::string path = library("outer", source, "-linner '-Wl,-rpath,$ORIGIN'");
  const Digest before = digest(path);
  library("inner", "// A comment.\nint inner() { return 1; }\n", "-g");
  EXPECT_EQ(digest(path), before);
  library("inner", "int inner() { return 2; }\n");
  EXPECT_NE(digest(path), before);
}

TEST_F(LibraryDigest, ALibraryOfOursThatALibraryOfOursNeedsCounts) {
  const std::string path_flags = " '-Wl,-rpath,$ORIGIN'";
  library("deep", "int deep() { return 1; }\n");
  library("inner", "int deep(); int inner() { return deep(); }\n", "-ldeep" + path_flags);
  const std::string path =
      library("outer", "int inner(); int outer() { return inner(); }\n", "-linner -Wl,-rpath-link,." + path_flags);
  const Digest before = digest(path);
  library("deep", "int deep() { return 2; }\n");
  EXPECT_NE(digest(path), before);
}

TEST_F(LibraryDigest, ALibraryInAFolderOfOursIsOursWithoutARunPath) {
  library("inner", "int inner() { return 1; }\n", "-Wl,--build-id=none");
  const std::string path = library("outer", "int inner(); int outer() { return inner(); }\n", "-linner");
  const Digest before = library_digest(path, {folder_});
  const Digest unknown = library_digest(path, {});
  EXPECT_NE(before, unknown);
  library("inner", "int inner() { return 2; }\n", "-Wl,--build-id=none");
  EXPECT_NE(library_digest(path, {folder_}), before);
  EXPECT_EQ(library_digest(path, {}), unknown);
}

TEST_F(LibraryDigest, AForeignLibraryCountsByItsBuildId) {
  fs::create_directory(folder_ + "/foreign");
  const auto foreign = [&](const std::string& body, const std::string& id) {
    const std::string path = library("other", "int other() { return " + body + "; }\n", "-Wl,--build-id=0x" + id);
    fs::copy_file(path, folder_ + "/foreign/libother.so", fs::copy_options::overwrite_existing);
  };
  foreign("1", "aabb");
  const std::string path =
      library("outer", "int other(); int outer() { return other(); }\n", "-lother -Wl,-rpath," + folder_ + "/foreign");
  const Digest before = digest(path);
  foreign("2", "aabb");
  EXPECT_EQ(digest(path), before);
  foreign("2", "aabc");
  EXPECT_NE(digest(path), before);
}

TEST_F(LibraryDigest, TheEngineAndTheRuntimeDoNotCount) {
  const std::string source = "int run(); int outer() { return run(); }\n";
  library("engine", "int run() { return 1; }\n");
  const std::string path = library("outer", source, "-lengine '-Wl,-rpath,$ORIGIN'");
  const Digest before = digest(path);
  library("engine", "int run() { return 2; }\n");
  EXPECT_EQ(digest(path), before);
}

TEST_F(LibraryDigest, LibrariesThatNeedEachOtherEnd) {
  library("inner", "int inner() { return 1; }\n");
  library("outer", "int inner(); int outer() { return inner(); }\n", "-Wl,--no-as-needed -linner '-Wl,-rpath,$ORIGIN'");
  library("inner", "int inner() { return 1; }\n", "-Wl,--no-as-needed -louter '-Wl,-rpath,$ORIGIN'");
  EXPECT_FALSE(digest(folder_ + "/libouter.so").empty());
}

TEST_F(LibraryDigest, ReadsASectionWithoutLoadingTheLibrary) {
  const std::string path =
      library("toy",
              "__attribute__((section(\"my_tags\"), used)) extern const char tags[8] = \"magic 1\";\n"
              "__attribute__((constructor)) static void crash() { __builtin_trap(); }\n");
  EXPECT_EQ(read_section(path, "my_tags"), std::string("magic 1\0", 8));
  EXPECT_EQ(read_section(path, "no_such_section"), "");
  EXPECT_EQ(read_section(path, ".bss"), "");
}

TEST_F(LibraryDigest, SaysWhatIsNoLibrary) {
  EXPECT_THROW_TEXT(digest(folder_ + "/absent.so"), "cannot read " + folder_ + "/absent.so: No such file or directory");
  const std::string path = written("");
  const std::string start = path + " is no usable shared library: ";
  EXPECT_THROW_TEXT(digest(path), start + "it is not an ELF file");
  written("#!/bin/sh\n");
  EXPECT_THROW_TEXT(digest(path), start + "it is not an ELF file");
  const std::string good = content(library("toy", "int twice(int x) { return 2 * x; }\n"));
  written(good.substr(0, 40));
  EXPECT_THROW_TEXT(digest(path), start + "it is truncated: the file has 40 bytes");
  written(good.substr(0, 100));
  EXPECT_THROW_TEXT(digest(path),
                    start + "it is truncated: expected the program headers at bytes 64 to 120, the file has 100");
  std::string arm = good;
  arm[offsetof(Elf64_Ehdr, e_machine)] = static_cast<char>(183);
  written(arm);
  EXPECT_THROW_TEXT(digest(path), start + "it is not for x86-64 (its machine is 183, expected 62)");
  std::string object = good;
  object[offsetof(Elf64_Ehdr, e_type)] = 1;
  written(object);
  EXPECT_THROW_TEXT(digest(path), start + "its type is 1, expected 3 (a shared object)");
  EXPECT_THROW_TEXT(digest(folder_), "cannot read " + folder_ + ": it is a folder");
}

// Whatever the bytes are, the answer is a digest or an error, never a crash or a read outside (the sanitizers watch).
TEST_F(LibraryDigest, SurvivesDamagedLibraries) {
  const std::string good = content(library("toy", "int twice(int x) { return 2 * x; }\n"));
  const auto attempt = [&](const std::string& bytes) {
    const std::string path = written(bytes);
    try {
      digest(path);
    } catch (const engine::PluginError&) {
    }
    try {
      read_section(path, "my_tags");
    } catch (const engine::PluginError&) {
    }
  };
  for (std::size_t size = 0; size < good.size(); size += size < 1500 ? 13 : 487) attempt(good.substr(0, size));
  for (std::size_t at = 0; at < 1500; ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(0xff);
    attempt(bad);
  }
  Elf64_Ehdr header;
  std::memcpy(&header, good.data(), sizeof header);
  for (std::size_t at = header.e_shoff; at < good.size(); at += 3) {
    std::string bad = good;
    bad[at] = static_cast<char>(0xff);
    attempt(bad);
  }
}

}  // namespace
