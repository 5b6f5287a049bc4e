#include "programs/topics/player.h"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "hal/types/overloaded.h"
#include "programs/topics/ending.h"
#include "programs/topics/flows.h"
#include "programs/topics/processes.h"
#include "programs/topics/schedule.h"

namespace programs::topics {
namespace {

std::uint32_t largest(const WrittenTopic& topic) {
  if (const auto* const recorded = std::get_if<Recorded>(&topic.rhythm)) {
    std::uint32_t most = kLeastSize;
    for (const Recorded::Sample& one : recorded->samples) most = std::max(most, one.bytes);
    return most;
  }
  return std::visit(hal::Overloaded{[](const SizeCycle& c) {
                                      return *std::max_element(c.sizes.begin(), c.sizes.end());
                                    },
                                    [](const UniformSizes& c) { return c.to; }},
                    topic.sizes);
}

/// Plays one topic until the end.
void play_topic(Schedule schedule, Instant begin, const std::string& name, const Write& write,
                std::pair<Journal&, Ending&> shared) {
  auto& [journal, ending] = shared;
  while (const auto due = schedule.next()) {
    const Instant at = begin + due->at;
    if (!ending.sleep_until(at)) return;
    const hal::Duration late = std::chrono::steady_clock::now() - at;
    const bool was_accepted = write(due->bytes);
    journal.wrote(name, was_accepted, late.count());
  }
}

/// Plays what one participant writes and reads, and the flows of UDP.
int play_participant(const Plan& plan, const MakeParticipant& make, const sigset_t& end_signals,
                     const Keep& keep) {
  const Instant start = std::chrono::steady_clock::now();
  Journal journal(plan.name);
  Ending ending;
  ending.sleep_until(start + participant_shift(plan));
  const std::unique_ptr<Participant> participant = make(plan, journal);
  for (const ReadTopic& topic : plan.reads) participant->read(topic);
  std::vector<std::thread> threads;
  std::vector<Write> writes;
  for (const WrittenTopic& topic : plan.writes) {
    journal.add_written(topic.name);
    writes.push_back(participant->write(topic, largest(topic)));
  }
  const Flows flows(plan, start + plan.begin + recording_shift(plan), journal, ending);
  for (std::size_t i = 0; i < writes.size(); ++i) {
    threads.emplace_back([&, i] {
      play_topic(Schedule(plan, plan.writes[i]), start + plan.begin, plan.writes[i].name, writes[i],
                 {journal, ending});
    });
  }
  int signal = 0;
  sigwait(&end_signals, &signal);
  const int status = keep(journal.close()) ? EXIT_SUCCESS : EXIT_FAILURE;
  if (signal == SIGTERM) std::_Exit(status);
  ending.end();
  for (std::thread& thread : threads) thread.join();
  return status;
}

int play_plan(const Plan& plan, const MakeParticipant& make, const sigset_t& end_signals) {
  std::ofstream out(plan.journal);  // its folder may be renamed from here on
  if (!out) throw std::runtime_error(plan.journal.string() + ": cannot be written");
  const Keep keep = [&out](const std::string& journal) {
    out << journal << std::flush;
    if (!out) std::fprintf(stderr, "the journal cannot be written\n");
    return out.good();
  };
  const std::vector<std::uint32_t> participants = participants_of(plan);
  if (participants.size() == 1) return play_participant(plan, make, end_signals, keep);
  std::vector<std::string> journals;
  const int status = play_apart(
      participants,
      [&](std::uint32_t one, const Keep& keep_part) {
        return play_participant(part_of(plan, one), make, end_signals, keep_part);
      },
      end_signals, journals);
  const bool is_kept = keep(joined(journals));
  return is_kept ? status : EXIT_FAILURE;
}

}  // namespace

int play(int argc, char** argv, const MakeParticipant& make) {
  if (argc != 2) {
    std::fprintf(stderr,
                 "usage: %s PLAN.json\nPlays DDS traffic that `topics:` of a scenario "
                 "describes; `baraka run` starts it.\n",
                 argv[0]);
    return 2;
  }
  sigset_t end_signals;
  sigemptyset(&end_signals);
  sigaddset(&end_signals, SIGTERM);
  sigaddset(&end_signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &end_signals, nullptr);  // of all threads, DDS's too
  try {
    return play_plan(read_plan(argv[1]), make, end_signals);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", argv[0], e.what());
    return 1;
  }
}

}  // namespace programs::topics
