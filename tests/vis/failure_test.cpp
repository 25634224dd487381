// Full disks, missing folders and damaged files: a clear IoFailure, and nothing half-written.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <functional>

#include "sim/core/errors.hpp"
#include "tests/vis/sample.hpp"
#include "vis/info.hpp"
#include "vis/writers.hpp"

namespace witherfield::vis {
namespace {

using Write = std::function<void(const std::filesystem::path&)>;

const std::vector<std::pair<const char*, Write>>& writers() {
  static const std::vector<std::pair<const char*, Write>> all{
      {"a.vti",
       [](const auto& f) {
         const TexelGrid grid = sample::texel(64, 20, 0.4);
         write_texel_vti(f, grid, sample::box_of(grid), false, {});
       }},
      {"p.vtp", [](const auto& f) { write_points_vtp(f, sample::points(sample::texel(64, 20, 0.4)), {}); }},
      {"t.vtp",
       [](const auto& f) {
         const sample::Hill hill = sample::hill(40);
         write_terrain_vtp(f, hill.mesh, hill.elevation_m, hill.placement);
       }},
      {"s.pvd",
       [](const auto& f) {
         write_pvd(f, {{0, "a.vti"}});
       }},
      {"v.py", [](const auto& f) {
         write_paraview_script(f, "grass", {{"water", {0, 1}}});
       }}};
  return all;
}

std::string failure_of(const Write& write, const std::filesystem::path& file) {
  try {
    write(file);
  } catch (const IoFailure& e) {
    return e.what();
  }
  return "";
}

TEST(WriteFailure, FullDeviceLeavesNothingAndNamesTheFile) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const auto& [name, write] : writers()) {
    const sample::Folder folder;
    std::filesystem::create_symlink("/dev/full", folder / (std::string(name) + ".part"));
    const std::string message = failure_of(write, folder / name);
    EXPECT_NE(message.find((folder / name).string()), std::string::npos) << name << ": " << message;
    EXPECT_NE(message.find("No space left"), std::string::npos) << message;
    EXPECT_TRUE(folder.names().empty()) << name;
  }
}

TEST(WriteFailure, OlderFileSurvivesAFailedWrite) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const auto& [name, write] : writers()) {
    const sample::Folder folder;
    write(folder / name);
    const std::string before = sample::content(folder / name);
    std::filesystem::create_symlink("/dev/full", folder / (std::string(name) + ".part"));
    EXPECT_THROW(write(folder / name), IoFailure) << name;
    EXPECT_TRUE(sample::content(folder / name) == before) << name;
    EXPECT_EQ(folder.names(), std::vector<std::string>{name});
  }
}

TEST(WriteFailure, SizeLimitInTheMiddleOfTheFileLeavesNothing) {
  const sample::Folder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 20000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = failure_of(writers()[0].second, folder / "a.vti");
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_TRUE(folder.names().empty());
}

TEST(WriteFailure, MissingFolderIsNamed) {
  const sample::Folder folder;
  for (const auto& [name, write] : writers()) {
    const std::string message = failure_of(write, folder / "missing" / name);
    EXPECT_NE(message.find("missing"), std::string::npos) << name << ": " << message;
  }
}

TEST(ReadFailure, CutFilesAreReportedWhereverTheyEnd) {
  const sample::Folder folder;
  for (const std::size_t w : {0u, 1u, 2u}) {
    const auto& [name, write] = writers()[w];
    write(folder / name);
    const std::string whole = sample::content(folder / name);
    // All arrays end before the closing tags, which VTK does not miss.
    const std::size_t data_end = whole.rfind("\n  </AppendedData>");
    for (const double share : {0.0, 0.01, 0.3, 0.6, 0.95, 0.999}) {
      std::ofstream(folder / name, std::ios::binary)
          << whole.substr(0, std::size_t(double(data_end) * share));
      EXPECT_THROW(file_info(folder / name), IoFailure) << name << " cut at " << share;
    }
  }
}

TEST(ReadFailure, FlippedBytesNeverCrash) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers stop at absurd allocations that otherwise throw";
#endif
  const sample::Folder folder;
  writers()[0].second(folder / "a.vti");
  const std::string whole = sample::content(folder / "a.vti");
  const std::size_t data = whole.find("   _") + 4;
  int failures = 0;
  // The block headers of the first array: counts and sizes that would ask for absurd memory.
  for (const std::size_t at :
       {data, data + 5, data + 8, data + 13, data + 16, data + 24, data + 29, data + 200}) {
    std::string broken = whole;
    broken[at] = static_cast<char>(broken[at] ^ 0x7F);
    std::ofstream(folder / "a.vti", std::ios::binary) << broken;
    try {
      file_info(folder / "a.vti");
    } catch (const IoFailure&) {
      ++failures;
    }
  }
  EXPECT_GE(failures, 4);
}

TEST(ReadFailure, NothingIsPrinted) {
  const sample::Folder folder;
  writers()[0].second(folder / "a.vti");
  const std::string whole = sample::content(folder / "a.vti");
  std::ofstream(folder / "a.vti", std::ios::binary) << whole.substr(0, whole.size() / 2);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_THROW(file_info(folder / "a.vti"), IoFailure);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(ReadFailure, OtherFilesAreRefused) {
  const sample::Folder folder;
  EXPECT_THROW(file_info(folder / "none.vti"), IoFailure);
  EXPECT_THROW(file_info(folder / "none.pvd"), IoFailure);
  EXPECT_THROW(file_info(folder.path()), IoFailure);
  for (const char* name : {"a.vti", "a.vtp", "a.pvd", "a.txt"}) {
    std::ofstream(folder / name) << "no XML at all";
    EXPECT_THROW(file_info(folder / name), IoFailure) << name;
  }
  std::ofstream(folder / "b.pvd") << "<?xml version=\"1.0\"?><VTKFile type=\"Collection\"><Collection>"
                                     "<DataSet timestep=\"soon\" file=\"a.vti\"/></Collection></VTKFile>";
  EXPECT_THROW(file_info(folder / "b.pvd"), IoFailure);
}

}  // namespace
}  // namespace witherfield::vis
