(* SPDX-License-Identifier: Apache-2.0 *)
(* Has each goal of a function tried by the prover that is recorded for it, and by no other.

   It decides who is asked first, and nothing else: the goals, the provers and the verdicts are
   WP's own, and the passes of WP that follow take up every goal that is not proved then.

   KEEL_RECORDED names a file: the function and, if not all of its goals are WP's, those that are, as
   -wp-prop has them; then a goal and its prover on each line. *)

let recorded : (string, string) Hashtbl.t = Hashtbl.create 97
let provers : string list ref = ref []

let read channel =
  let selection = String.split_on_char ' ' (input_line channel) in
  (try
     while true do
       Scanf.sscanf (input_line channel) "%s %s" (fun goal prover ->
           Hashtbl.replace recorded ("typed_" ^ goal) prover;
           if not (List.mem prover !provers) then provers := !provers @ [ prover ])
     done
   with End_of_file -> ());
  (List.hd selection, List.tl selection)

(* A goal of a call through a pointer ends in the number of its statement, which no list has. *)
let without_statement goal =
  match String.rindex_opt goal '_' with
  | Some place
    when place + 1 < String.length goal && goal.[place + 1] = 's' ->
      String.sub goal 0 place
  | _ -> goal

let prover_of vc =
  let goal = Wp.VC.get_id vc in
  match Hashtbl.find_opt recorded goal with
  | Some prover -> Some prover
  | None -> Hashtbl.find_opt recorded (without_statement goal)

let ask kf prop =
  let goals = Wp.VC.generate_kf ~prop kf in
  let before = Wp.Wp_parameters.Provers.get () in
  List.iter
    (fun prover ->
      let chosen = Bag.filter (fun vc -> prover_of vc = Some prover) goals in
      Wp.Wp_parameters.Provers.set [ prover ];
      if not (Bag.is_empty chosen) then Wp.VC.command chosen)
    !provers;
  Wp.Wp_parameters.Provers.set before

(* Frama-C calls this before each pass of the command line. *)
let waiting = ref true

let main () =
  if !waiting then begin
    waiting := false;
    let channel = open_in (Sys.getenv "KEEL_RECORDED") in
    let name, prop = read channel in
    close_in channel;
    match Globals.Functions.find_by_name name with
    | kf -> ask kf prop
    | exception Not_found -> ()
  end

let () = Db.Main.extend main
