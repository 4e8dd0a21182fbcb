(* SPDX-License-Identifier: Apache-2.0 *)
(* Looks for contradictions among what the proof of a function assumes, by WP's own smoke tests.

   WP would test after each statement whether what holds there proves false. All of that holds at the
   statements, too, to which every way leads past it; so a test is removed where another one comes
   behind it. What nothing proves is tested apart: preconditions and assumptions of behaviours. What
   a function promises that is called through a pointer is met by the tests behind the call: WP's own
   test of such a call stands before the promise.

   KEEL_SMOKE is the prover, its steps, the function and, if not all of its goals are WP's, those that
   are, as -wp-prop has them. *)

open Cil_types

type place = Before of stmt | After of stmt | Other

let statement number = fst (Kernel_function.find_from_sid number)

(* WP tells in a test's name alone where it looks. *)
let place_of test =
  let name = Wp.Wpo.get_gid test in
  match List.rev (String.split_on_char '_' name) with
  | number :: kind :: "dead" :: _ when number.[0] = 's' -> (
      let number = int_of_string (String.sub number 1 (String.length number - 1)) in
      match kind with
      | "code" -> Before (statement number)
      | "call" -> After (statement number)
      | _ -> Other)
  | _ -> Other

(* Whether what holds at a place holds at another, too. *)
let is_before first place =
  match (first, place) with
  | Before a, After b -> Dominators.dominates a b
  | (Before a | After a), (Before b | After b) -> a != b && Dominators.dominates a b
  | _ -> false

(* The tests of a function that are worth asking; the others are removed. *)
let tests_of kf prop =
  let tests = ref [] in
  let goals = Wp.VC.generate_kf ~prop kf in
  Wp.Wpo.iter_on_goals (fun goal ->
      if Wp.Wpo.is_smoke_test goal then tests := (goal, place_of goal) :: !tests);
  let others, kept =
    List.partition
      (fun (_, place) -> List.exists (fun (_, other) -> is_before place other) !tests)
      !tests
  in
  List.iter (fun (goal, _) -> Wp.Wpo.remove goal) others;
  let names = List.map (fun (goal, _) -> Wp.Wpo.get_gid goal) kept in
  Bag.filter (fun goal -> List.mem (Wp.VC.get_id goal) names) goals

let look prover steps prop kf =
  let open Wp.Wp_parameters in
  let provers = Provers.get () and before = Steps.get () in
  SmokeTests.set true;
  Provers.set [ prover ];
  Steps.set steps;
  let tests = tests_of kf prop in
  if not (Bag.is_empty tests) then Wp.VC.command tests;
  SmokeTests.set false;
  Provers.set provers;
  Steps.set before

(* Frama-C calls this before each pass of the command line. *)
let waiting = ref true

let main () =
  if !waiting then begin
    waiting := false;
    match String.split_on_char ' ' (Sys.getenv "KEEL_SMOKE") with
    | prover :: steps :: name :: prop -> (
        match Globals.Functions.find_by_name name with
        | kf -> look prover (int_of_string steps) prop kf
        | exception Not_found -> ())
    | _ -> invalid_arg "KEEL_SMOKE"
  end

let () = Db.Main.extend main
