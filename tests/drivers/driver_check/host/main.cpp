// SPDX-License-Identifier: Apache-2.0
// driver_check DIRECTORY: runs the checks on all drivers that this machine can run, and on drivers with one fault each,
// which the check that is named with the fault must detect. Prints "1..N" and N lines "ok …" or "not ok …".
#include <cstdio>
#include <memory>
#include <set>

#include "example.hpp"
#include "mutants.hpp"
#include "settings.hpp"

namespace {

using check::Case;
using check::Mutant;
using check::Setting;
using Run = void (*)(CO_DRIVER_CHECK*);

class Results {
 public:
  void say(bool good, const std::string& text) {
    ++num_;
    failed_ += good ? 0U : 1U;
    std::printf("%sok %s\n", good ? "" : "not ", text.c_str());
  }
  int end() const {
    std::printf("1..%u\n", num_);
    return failed_ == 0 ? 0 : 1;
  }

 private:
  unsigned num_ = 0;
  unsigned failed_ = 0;
};

// Reports each verdict on a correct driver as a case, and compares the number of skipped checks with the expected one.
void judge_good(const Case& each, Run run, Results& results, std::set<std::string>& names) {
  const auto setting = std::make_unique<Setting>();
  each.prepare(*setting);
  run(&setting->check);
  for (const std::string& line : setting->report.lines) {
    if (line.rfind("skipped ", 0) != 0) {
      results.say(line.rfind("ok ", 0) == 0, std::string(each.name) + ", " + line.substr(line.find("ok ") + 3));
    }
  }
  for (const auto& [name, verdict] : setting->report.verdicts()) {
    if (verdict != "skipped ") {
      names.insert(name);
    }
  }
  const std::uint16_t skipped = setting->check.Skipped;
  results.say(skipped == each.skipped,
              std::string(each.name) + ", checks that do not apply: " + std::to_string(skipped));
}

void judge_bad(const Mutant& mutant, Run run, Results& results, std::set<std::string>& found) {
  const auto setting = std::make_unique<Setting>();
  mutant.spoil(*setting);
  run(&setting->check);
  const auto verdicts = setting->report.verdicts();
  const auto verdict = verdicts.find(mutant.caught_by);
  const bool caught = verdict != verdicts.end() && verdict->second == "not ok ";
  results.say(caught, std::string(mutant.caught_by) + " finds: " + mutant.name);
  if (caught) {
    found.insert(mutant.caught_by);
    return;
  }
  for (const std::string& line : setting->report.lines) {
    std::printf("#   %s\n", line.c_str());
  }
}

void judge(const std::vector<Case>& cases, const std::vector<Mutant>& mutants, Run run, Results& results) {
  std::set<std::string> names;
  std::set<std::string> found;
  for (const Case& each : cases) {
    judge_good(each, run, results, names);
  }
  for (const Mutant& mutant : mutants) {
    judge_bad(mutant, run, results, found);
  }
  for (const std::string& name : names) {
    results.say(found.count(name) != 0, name + " can fail");
  }
}

void judge_loop(Results& results) {
  constexpr unsigned moments = 200;
  const unsigned careful = check::answered_by_loop(moments, true);
  const unsigned careless = check::answered_by_loop(moments, false);
  results.say(careful == moments,
              "a loop that sleeps answers whenever a frame comes: " + std::to_string(careful) + " of 200");
  results.say(careless < moments,
              "one that does not ask before it sleeps does not: " + std::to_string(careless) + " of 200");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "driver_check DIRECTORY\n");
    return 2;
  }
  Results results;
  judge(check::can_cases(), check::can_mutants(), CODriverCheckCan, results);
  judge(check::timer_cases(), check::timer_mutants(), CODriverCheckTimer, results);
  judge(check::nvm_cases(argv[1]), check::nvm_mutants(), CODriverCheckNvm, results);
  judge_loop(results);
  return results.end();
}
