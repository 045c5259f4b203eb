// SPDX-License-Identifier: Apache-2.0
#include "gen/gen.hpp"

#include "gen/eds.hpp"
#include "gen/names.hpp"

namespace lexican::codict::gen {

std::string default_name(std::string_view path) {
  path.remove_prefix(path.find_last_of('/') + 1);
  const std::string name = identifier(path.substr(0, path.find_last_of('.')));
  return name.empty() ? "device" : name;
}

std::string header_name(const Options& options) { return options.name + "_od.h"; }

std::string source_name(const Options& options) {
  return options.name + (options.language == Language::cpp ? "_od.cpp" : "_od.c");
}

Output generate(const Device& device, const Options& options, Findings& findings) {
  const std::size_t errors = findings.count(Severity::error);
  const bool embeds = options.embedded_eds != EmbeddedEds::none;
  Device with_eds;
  if (embeds) {
    with_eds = device;
    add_eds_objects(with_eds);
  }
  const Device& source = embeds ? with_eds : device;
  Plan plan = make_plan(source, options, findings);
  if (findings.count(Severity::error) != errors) {
    return {};
  }
  if (embeds) {
    embed_eds(source, options.name + ".eds", options, plan);
  }
  Output output = generate(plan, options);
  output.device = described(source, plan);
  return output;
}

Output generate(const Plan& plan, const Options& options) {
  Output output;
  output.files.push_back({header_name(options), write_header(plan, options)});
  output.files.push_back({source_name(options), write_source(plan, options)});
  output.costs = costs_of(plan);
  output.groups = stored_groups(plan);
  output.externals = externals_of(plan, options);
  output.verify = write_verify(plan, options);
  output.stubs = output.externals.empty() ? "" : write_stubs(plan, options);
  return output;
}

}  // namespace lexican::codict::gen
