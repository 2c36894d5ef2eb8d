#include "files.h"

#include <doctest/doctest.h>

#include "cli/support.h"

using namespace wireskin_cli;
using namespace cli_test;

TEST_CASE("files appear together, and only with commit") {
  const ScratchFolder scratch("files");
  write_file(scratch / "a", "old");
  {
    OutputFiles files;
    files.add(scratch / "a", "new");
    files.add(scratch / "b", std::string("\0\r\n", 3));
    CHECK(read_file(scratch / "a") == "old");
    CHECK_FALSE(fs::exists(scratch / "b"));
    files.commit();
  }
  CHECK(read_file(scratch / "a") == "new");
  CHECK(read_file(scratch / "b") == std::string("\0\r\n", 3));
  CHECK(scratch.file_count() == 2);
}

TEST_CASE("without commit nothing is left and nothing is lost") {
  const ScratchFolder scratch("files");
  write_file(scratch / "a", "old");
  {
    OutputFiles files;
    files.add(scratch / "a", "new");
    files.add(scratch / "b", "new");
  }
  CHECK(read_file(scratch / "a") == "old");
  CHECK(scratch.file_count() == 1);
}

TEST_CASE("targets that cannot be written") {
  const ScratchFolder scratch("files");
  fs::create_directory(scratch / "folder");
  OutputFiles files;
  const std::string folder = scratch / "folder";
  CHECK(failure_of([&] { files.add(folder, "x"); }) ==
        folder + ": cannot be written: Is a directory");
  const std::string nowhere = scratch / "missing/file";
  CHECK(failure_of([&] { files.add(nowhere, "x"); }) ==
        nowhere + ": cannot be written: No such file or directory");
  CHECK(scratch.file_count() == 1);
}

TEST_CASE("a file that stands under the temporary name is kept") {
  const ScratchFolder scratch("files");
  write_file(scratch / "a.part0", "mine");
  OutputFiles files;
  files.add(scratch / "a", "new");
  files.commit();
  CHECK(read_file(scratch / "a") == "new");
  CHECK(read_file(scratch / "a.part0") == "mine");
  CHECK(scratch.file_count() == 2);
}

TEST_CASE("none is left if one cannot get its name") {
  const ScratchFolder scratch("files");
  {
    OutputFiles files;
    files.add(scratch / "a", "new");
    files.add(scratch / "b", "new");
    fs::create_directories(scratch / "b/in the way");
    CHECK(failure_of([&] { files.commit(); }).find("cannot be written") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(scratch / "a"));
  CHECK(scratch.file_count() == 1);
}

#ifdef __unix__
TEST_CASE("a symbolic link stays one, and devices are written directly") {
  const ScratchFolder scratch("files");
  write_file(scratch / "real", "old");
  fs::create_symlink(scratch / "real", scratch / "link");
  OutputFiles files;
  files.add(scratch / "link", "new");
  files.commit();
  CHECK(fs::is_symlink(scratch / "link"));
  CHECK(read_file(scratch / "real") == "new");
  OutputFiles devices;
  devices.add("/dev/null", "x");
  devices.commit();
  CHECK(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full")) {
    CHECK(failure_of([&] { devices.add("/dev/full", "x"); }) ==
          "/dev/full: cannot be written: No space left on device");
  }
}
#endif

TEST_CASE("extensions") {
  CHECK(extension_of("a.b/c.OBJ") == ".obj");
  CHECK(extension_of("a.b/c") == "");
}
