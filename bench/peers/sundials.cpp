// SPDX-License-Identifier: MIT
#include "sundials.hpp"

#if defined(JETLAG_HAVE_SUNDIALS)

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <arkode/arkode_mristep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <sundials/sundials_context.hpp>

namespace jetlag::bench {

namespace {

/// What failed says its return value; the messages of the library would stand between the rows of the table.
void quiet(int, const char*, const char*, char*, void*) {}

void must(int code, const char* what) {
  if (code < 0) throw std::runtime_error(std::string(what) + " returns " + std::to_string(code));
}

/// (x, v) in a vector of SUNDIALS.
class Unknowns {
 public:
  Unknowns(const State<double>& state, SUNContext context) {
    const std::vector<double> y = flat(state);
    vector_ = N_VNew_Serial(static_cast<sunindextype>(y.size()), context);
    std::ranges::copy(y, data());
  }
  Unknowns(const Unknowns&) = delete;
  Unknowns& operator=(const Unknowns&) = delete;
  ~Unknowns() { N_VDestroy(vector_); }
  operator N_Vector() const { return vector_; }
  double* data() const { return N_VGetArrayPointer(vector_); }

 private:
  N_Vector vector_;
};

/// 0: evaluated; 1: not finite, and the step should be shorter; -1: the time is used up.
int evaluate(Forces& forces, double t, const double* y, double* a) {
  const std::size_t n = forces.unknowns();
  if (forces(t, y, y + n, a)) return 0;
  return forces.out_of_time() ? -1 : 1;
}

/// y' = (v, a).
int rate(realtype t, N_Vector y, N_Vector result, void* forces_of_run) {
  Forces& forces = *static_cast<Forces*>(forces_of_run);
  const double* from = N_VGetArrayPointer(y);
  double* to = N_VGetArrayPointer(result);
  const std::size_t n = forces.unknowns();
  std::copy_n(from + n, n, to);
  return evaluate(forces, t, from, to + n);
}

/// y' = (0, a): the slow forces only; motion itself is fast.
int slow_rate(realtype t, N_Vector y, N_Vector result, void* forces_of_run) {
  Forces& forces = *static_cast<Forces*>(forces_of_run);
  double* to = N_VGetArrayPointer(result);
  const std::size_t n = forces.unknowns();
  std::fill_n(to, n, 0.0);
  return evaluate(forces, t, N_VGetArrayPointer(y), to + n);
}

/// A solver's memory, freed by its own function.
using Memory = std::unique_ptr<void, void (*)(void*)>;
template <void (*free)(void**)>
Memory own(void* memory) {
  if (memory == nullptr) throw std::runtime_error("SUNDIALS creates no solver");
  return Memory(memory, [](void* p) { free(&p); });
}

template <class Run>
Ending ending(const PeerProblem& problem, const Run& run) {
  try {
    return run();
  } catch (const std::runtime_error& error) {
    return {problem.start, 0, error.what()};
  }
}

/// A pair of explicit methods with steps by its estimate.
auto explicit_pair(ARKODE_ERKTableID table) {
  return [table](const PeerProblem& problem, const Asked& asked) {
    return ending(problem, [&]() -> Ending {
      const sundials::Context context;
      Forces forces(problem.system, asked.seconds);
      const Unknowns y(problem.start, context);
      const Memory solver = own<ERKStepFree>(ERKStepCreate(rate, 0.0, y, context));
      void* const s = solver.get();
      must(ERKStepSetErrHandlerFn(s, quiet, nullptr), "ERKStepSetErrHandlerFn");
      must(ERKStepSetUserData(s, &forces), "ERKStepSetUserData");
      must(ERKStepSetTableNum(s, table), "ERKStepSetTableNum");
      must(ERKStepSStolerances(s, asked.setting, asked.setting), "ERKStepSStolerances");
      must(ERKStepSetMaxNumSteps(s, -1), "ERKStepSetMaxNumSteps");
      must(ERKStepSetStopTime(s, problem.until), "ERKStepSetStopTime");
      double reached = 0;
      must(ERKStepEvolve(s, problem.until, y, &reached, ARK_NORMAL), "ERKStepEvolve");
      return {state_of(y.data(), problem),
              forces.element_coefficients() / static_cast<double>(problems::element_count(problem.system))};
    });
  };
}

/// Diagonally implicit; Newton with GMRES, no matrix, no preconditioner.
auto implicit(int order) {
  return [order](const PeerProblem& problem, const Asked& asked) {
    return ending(problem, [&]() -> Ending {
      const sundials::Context context;
      Forces forces(problem.system, asked.seconds);
      const Unknowns y(problem.start, context);
      const std::unique_ptr<_generic_SUNLinearSolver, int (*)(SUNLinearSolver)> gmres(
          SUNLinSol_SPGMR(y, SUN_PREC_NONE, 0, context), SUNLinSolFree);
      const Memory solver = own<ARKStepFree>(ARKStepCreate(nullptr, rate, 0.0, y, context));
      void* const s = solver.get();
      must(ARKStepSetErrHandlerFn(s, quiet, nullptr), "ARKStepSetErrHandlerFn");
      must(ARKStepSetUserData(s, &forces), "ARKStepSetUserData");
      must(ARKStepSetOrder(s, order), "ARKStepSetOrder");
      must(ARKStepSStolerances(s, asked.setting, asked.setting), "ARKStepSStolerances");
      must(ARKStepSetLinearSolver(s, gmres.get(), nullptr), "ARKStepSetLinearSolver");
      must(ARKStepSetMaxNumSteps(s, -1), "ARKStepSetMaxNumSteps");
      must(ARKStepSetStopTime(s, problem.until), "ARKStepSetStopTime");
      double reached = 0;
      must(ARKStepEvolve(s, problem.until, y, &reached, ARK_NORMAL), "ARKStepEvolve");
      return {state_of(y.data(), problem),
              forces.element_coefficients() / static_cast<double>(problems::element_count(problem.system))};
    });
  };
}

/// Stiff elements fast, by a pair of Dormand and Prince with a tolerance of a tenth of the error wanted; the others slow, with
/// the step of the setting.
auto multirate(ARKODE_MRITableID table) {
  return [table](const PeerProblem& problem, const Asked& asked) {
    return ending(problem, [&]() -> Ending {
      const sundials::Context context;
      Forces fast(problem.split->fast, asked.seconds), slow(problem.split->slow, asked.seconds);
      const Unknowns y(problem.start, context);

      const Memory inner = own<ARKStepFree>(ARKStepCreate(rate, nullptr, 0.0, y, context));
      void* const i = inner.get();
      const double tolerance = asked.target / 10;
      must(ARKStepSetErrHandlerFn(i, quiet, nullptr), "ARKStepSetErrHandlerFn");
      must(ARKStepSetUserData(i, &fast), "ARKStepSetUserData");
      must(ARKStepSetTableNum(i, ARKODE_DIRK_NONE, ARKODE_DORMAND_PRINCE_7_4_5), "ARKStepSetTableNum");
      must(ARKStepSStolerances(i, tolerance, tolerance), "ARKStepSStolerances");
      must(ARKStepSetMaxNumSteps(i, -1), "ARKStepSetMaxNumSteps");
      MRIStepInnerStepper created = nullptr;
      must(ARKStepCreateMRIStepInnerStepper(i, &created), "ARKStepCreateMRIStepInnerStepper");
      const auto free = [](MRIStepInnerStepper p) { MRIStepInnerStepper_Free(&p); };
      const std::unique_ptr<_MRIStepInnerStepper, decltype(free)> stepper(created, free);

      const Memory outer =
          own<MRIStepFree>(MRIStepCreate(slow_rate, nullptr, 0.0, y, stepper.get(), context));
      void* const o = outer.get();
      must(MRIStepSetErrHandlerFn(o, quiet, nullptr), "MRIStepSetErrHandlerFn");
      must(MRIStepSetUserData(o, &slow), "MRIStepSetUserData");
      const MRIStepCoupling coupling = MRIStepCoupling_LoadTable(table);
      const int code = MRIStepSetCoupling(o, coupling);
      MRIStepCoupling_Free(coupling);
      must(code, "MRIStepSetCoupling");
      must(MRIStepSetFixedStep(o, EqualSteps(problem.until, asked.setting).step), "MRIStepSetFixedStep");
      must(MRIStepSetMaxNumSteps(o, -1), "MRIStepSetMaxNumSteps");
      must(MRIStepSetStopTime(o, problem.until), "MRIStepSetStopTime");
      double reached = 0;
      must(MRIStepEvolve(o, problem.until, y, &reached, ARK_NORMAL), "MRIStepEvolve");
      return {state_of(y.data(), problem), (fast.element_coefficients() + slow.element_coefficients()) /
                                               static_cast<double>(problems::element_count(problem.system))};
    });
  };
}

/// Adams's methods of variable order up to 12, functional iteration.
Ending adams(const PeerProblem& problem, const Asked& asked) {
  return ending(problem, [&]() -> Ending {
    const sundials::Context context;
    Forces forces(problem.system, asked.seconds);
    const Unknowns y(problem.start, context);
    const std::unique_ptr<_generic_SUNNonlinearSolver, int (*)(SUNNonlinearSolver)> iteration(
        SUNNonlinSol_FixedPoint(y, 0, context), SUNNonlinSolFree);
    const Memory solver = own<CVodeFree>(CVodeCreate(CV_ADAMS, context));
    void* const s = solver.get();
    must(CVodeInit(s, rate, 0.0, y), "CVodeInit");
    must(CVodeSetErrHandlerFn(s, quiet, nullptr), "CVodeSetErrHandlerFn");
    must(CVodeSetUserData(s, &forces), "CVodeSetUserData");
    must(CVodeSStolerances(s, asked.setting, asked.setting), "CVodeSStolerances");
    must(CVodeSetNonlinearSolver(s, iteration.get()), "CVodeSetNonlinearSolver");
    must(CVodeSetMaxNumSteps(s, -1), "CVodeSetMaxNumSteps");
    must(CVodeSetStopTime(s, problem.until), "CVodeSetStopTime");
    double reached = 0;
    must(CVode(s, problem.until, y, &reached, CV_NORMAL), "CVode");
    return {state_of(y.data(), problem),
            forces.element_coefficients() / static_cast<double>(problems::element_count(problem.system))};
  });
}

}  // namespace

std::vector<Method> sundials_methods() {
  return {
      {"sundials_erk_dopri5", false, 1e1, false, any_problem, explicit_pair(ARKODE_DORMAND_PRINCE_7_4_5)},
      {"sundials_erk_fehlberg78", false, 1e1, false, any_problem, explicit_pair(ARKODE_FEHLBERG_13_7_8)},
      {"sundials_dirk5", false, 1e1, false, any_problem, implicit(5)},
      {"sundials_cvode_adams", false, 1e1, false, any_problem, adams},
      {"sundials_mri3", true, 64, true, has_split, multirate(ARKODE_MIS_KW3)},
      {"sundials_mri4", true, 64, true, has_split, multirate(ARKODE_MRI_GARK_ERK45a)},
  };
}

}  // namespace jetlag::bench

#else

namespace jetlag::bench {
std::vector<Method> sundials_methods() { return {}; }
}  // namespace jetlag::bench

#endif
