# In which order ./test begins: alternately an entry that mostly waits, for clocks, devices and other processes, and one that
# mostly computes, the longest first of each, so that neither its places nor the processors are idle. Those that are not here
# come afterwards. COST, where it is set, outranks what ctest has measured.
set(waiting
    e2e.netns.2 e2e.agentd.2 e2e.strangers.2 e2e.strangers.0 e2e.drivers e2e.debugging.0 e2e.ip_routes.0
    e2e.lockstep_inside e2e.netns.1 e2e.view_live.1 e2e.agentd.1 e2e.dds_benches e2e.lockstep_stops e2e.forgery.0
    contract.0 e2e.dds_observables e2e.view_controls e2e.dds_profiles.0 e2e.topic.0 e2e.agentd.0 e2e.ip_routes.1
    e2e.dds_load e2e.dilation.1 e2e.view_page e2e.netns.0 e2e.teleop e2e.agentd.3 e2e.garbage
    e2e.topic.1 e2e.death.1 contract.1 contract.2 e2e.dds_profiles.1 e2e.gossip e2e.inspection.0 e2e.real_time.1
    e2e.real_time.0 unit_view_server unit_gateway_exchange.1 e2e.view_live.2 unit_gateway_exchange.0 e2e.faults
    e2e.air_programs.runs e2e.strangers.1 e2e.apart.0 e2e.apart.1 e2e.site e2e.ledger e2e.debugging.1 e2e.results.0
    e2e.death.0 e2e.view_live.0 e2e.sensors e2e.forgery.1 e2e.air_programs.programs unit_gateway_runtime e2e.battery
    e2e.inspection.1 e2e.coverage e2e.observables)
set(computing
    e2e.lockstep.1 e2e.radio_keys e2e.case_study e2e.udp_like e2e.priorities e2e.report e2e.python.1 e2e.many_robots.1
    e2e.topics e2e.many_robots.0 e2e.fleet.0 e2e.replications unit_sim_air_ledger analytic_radio.0
    e2e.fingerprint.0 e2e.lockstep.0 e2e.python_results e2e.drives e2e.campaign.0 contract.python.references e2e.results.1
    unit_programs_models analytic_radio.1 e2e.python.0 e2e.ros2 e2e.fingerprint.1 e2e.air
    e2e.channels e2e.numbers e2e.verdicts e2e.handover e2e.recordings e2e.dilation.0 e2e.command_line e2e.capsule
    e2e.manual e2e.install unit_sim_radio analytic_physics.1 e2e.events e2e.judge e2e.base_field e2e.diff e2e.fleet.1
    e2e.recording e2e.division_of_labour analytic_physics.0 unit_results_statistics
    unit_results_record e2e.direct e2e.map config)
set(cost 1000)
while(waiting OR computing)
  foreach(kind waiting computing)
    if(${kind})
      list(POP_FRONT ${kind} entry)
      if(TEST ${entry})  # some need what this machine may not have
        set_tests_properties(${entry} PROPERTIES COST ${cost})
      endif()
      math(EXPR cost "${cost} - 1")
    endif()
  endforeach()
endwhile()
