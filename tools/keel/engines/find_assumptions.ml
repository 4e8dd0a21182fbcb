(* SPDX-License-Identifier: Apache-2.0 *)
(* Tells what the annotations of a file take for granted, as Frama-C understands them: behind the
   preprocessor, its macros expanded, ghosts included. Each is a line "keel: assumed: FILE:LINE: WHAT".

   - what is admitted, or checked and then not relied on, and axioms;
   - logic that is declared and not defined, and inductive definitions;
   - definitions that call themselves but for a number that falls to a bound: a logic function that
     is its own successor proves anything;
   - functions that need not terminate, volatile and extended annotations;
   - ghost functions without a body: their contracts are believed and proved nowhere.

   And each function of which the file has a contract and no body, "keel: declared: NAME": somebody
   else must prove it. *)

open Cil_types

let tell (place : location) what =
  let start = fst place in
  Printf.printf "keel: assumed: %s:%d: %s\n"
    (Filepath.Normalized.to_pretty_string start.Filepath.pos_path)
    start.Filepath.pos_lnum what

(* The logic functions and predicates that a body calls. *)
let called body =
  let found = ref [] in
  let visitor =
    object
      inherit Visitor.frama_c_inplace

      method! vlogic_info_use info =
        found := info :: !found;
        Cil.DoChildren
    end
  in
  (match body with
  | LBterm term -> ignore (Visitor.visitFramacTerm visitor term)
  | LBpred predicate -> ignore (Visitor.visitFramacPredicate visitor predicate)
  | LBnone | LBreads _ | LBinductive _ -> ());
  !found

let is info other = Cil_datatype.Logic_info.equal info other

(* Whether a definition leads to another one. *)
let leads_to target body =
  let seen = ref [] in
  let rec from body =
    List.exists
      (fun one ->
        is one target
        || (not (List.exists (is one) !seen))
           && (seen := one :: !seen;
               from one.l_body))
      (called body)
  in
  from body

(* A cast may change a number: it stays. *)
let rec bare term =
  match term.term_node with
  | TLogic_coerce (_, inner) | Tat (inner, _) -> bare inner
  | _ -> term

let is_variable variable term =
  match (bare term).term_node with
  | TLval (TVar other, TNoOffset) -> Cil_datatype.Logic_var.equal variable other
  | _ -> false

let is_number test term =
  match (bare term).term_node with
  | TConst (Integer (value, _)) -> test value
  | TUnOp (Neg, inner) -> (
      match (bare inner).term_node with
      | TConst (Integer (value, _)) -> test (Integer.neg value)
      | _ -> false)
  | _ -> false

(* Whether a condition holds of every number from one on downwards. *)
let ends_below variable condition =
  match (bare condition).term_node with
  | TBinOp ((Le | Lt), left, right) -> is_variable variable left && is_number (fun _ -> true) right
  | TBinOp ((Ge | Gt), left, right) -> is_variable variable right && is_number (fun _ -> true) left
  | _ -> false

let is_less variable term =
  match (bare term).term_node with
  | TBinOp (MinusA, left, right) ->
      is_variable variable left && is_number (fun value -> Integer.gt value Integer.zero) right
  | _ -> false

(* Whether each call of a function in a term has less than a variable in the variable's place. *)
let falls info place variable term =
  let good = ref true in
  let visitor =
    object
      inherit Visitor.frama_c_inplace

      method! vterm one =
        (match one.term_node with
        | Tapp (other, _, arguments) when is info other ->
            good := !good && is_less variable (List.nth arguments place)
        | _ -> ());
        Cil.DoChildren
    end
  in
  ignore (Visitor.visitFramacTerm visitor term);
  !good

(* (n <= BOUND) ? base : ... f(n - NUMBER) ... *)
let is_well_founded info =
  match info.l_body with
  | LBterm body -> (
      match (bare body).term_node with
      | Tif (condition, base, step) ->
          (not (leads_to info (LBterm base)))
          && (not (leads_to info (LBterm condition)))
          && List.for_all (fun one -> is one info || not (leads_to info one.l_body))
               (called (LBterm step))
          && List.exists Fun.id
               (List.mapi
                  (fun place variable ->
                    ends_below variable condition && falls info place variable step)
                  info.l_profile)
      | _ -> false)
  | _ -> false

let look_at_logic place info =
  let name = info.l_var_info.lv_name in
  match info.l_body with
  | LBnone | LBreads _ -> tell place ("the logic " ^ name ^ " is declared, and not defined")
  | LBinductive _ -> tell place ("the inductive definition of " ^ name)
  | body ->
      if leads_to info body && not (is_well_founded info) then
        tell place (name ^ " is defined by itself, and not by a number that falls to a bound")

let kind predicate =
  match predicate.tp_kind with Assert -> None | Check -> Some "check" | Admit -> Some "admit"

let looking =
  object (self)
    inherit Visitor.frama_c_inplace

    method private place = Cil_const.CurrentLoc.get ()

    method private look predicate =
      match kind predicate with
      | Some word -> tell predicate.tp_statement.pred_loc word
      | None -> ()

    method! vannotation annotation =
      (match annotation with
      | Daxiomatic (name, _, _, place) -> tell place ("axiomatic " ^ name)
      | Dvolatile (_, _, _, _, place) -> tell place "volatile"
      | Dextended (_, _, place) -> tell place "an extended annotation"
      | Dmodel_annot (_, place) -> tell place "a model field"
      | Dlemma (_, _, _, predicate, _, _) -> self#look predicate
      | Dfun_or_pred (info, place) -> look_at_logic place info
      | Dtype _ | Dinvariant _ | Dtype_annot _ -> ());
      Cil.DoChildren

    method! vcode_annot annotation =
      (match annotation.annot_content with
      | AAssert (_, predicate) | AInvariant (_, _, predicate) -> self#look predicate
      | AExtended (_, _, extension) ->
          if extension.ext_name <> "calls" then
            tell extension.ext_loc ("an extended annotation: " ^ extension.ext_name)
      | APragma _ -> tell self#place "a pragma"
      | AStmtSpec _ | AVariant _ | AAssigns _ | AAllocation _ -> ());
      Cil.DoChildren

    method! vbehavior behavior =
      List.iter (fun one -> self#look one.ip_content) behavior.b_requires;
      List.iter (fun one -> self#look one.ip_content) behavior.b_assumes;
      List.iter (fun (_, one) -> self#look one.ip_content) behavior.b_post_cond;
      List.iter
        (fun one -> tell one.ext_loc ("an extended annotation: " ^ one.ext_name))
        behavior.b_extended;
      Cil.DoChildren

    method! vspec spec =
      (match spec.spec_terminates with
      | Some one ->
          self#look one.ip_content;
          if one.ip_content.tp_statement.pred_content <> Ptrue then
            tell one.ip_content.tp_statement.pred_loc "a function that need not terminate"
      | None -> ());
      Cil.DoChildren
  end

let look_at_function kf =
  if not (Kernel_function.is_definition kf) then begin
    let variable = Kernel_function.get_vi kf in
    if variable.vghost then
      tell (Kernel_function.get_location kf)
        ("the ghost function " ^ variable.vname ^ " has no body")
    else Printf.printf "keel: declared: %s\n" variable.vname
  end

let waiting = ref true

let main () =
  if !waiting then begin
    waiting := false;
    Visitor.visitFramacFileSameGlobals looking (Ast.get ());
    Globals.Functions.iter look_at_function;
    Printf.printf "keel: looked\n%!"
  end

let () = Db.Main.extend main
