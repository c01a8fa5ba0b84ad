; Valves of a pump: some exclude each other, and what a turn costs stands in the problem.
(define (domain valves)
  (:requirements :adl :action-costs)
  (:types small large - valve)
  (:predicates (open ?v - valve) (against ?v ?w - valve) (rinsed) (pressure))
  (:functions (total-cost) - number (effort ?v - valve) - number (once) - number)

  (:action turn
    :parameters (?v - valve)
    :precondition (and (not (open ?v))
                       (not (exists (?w - valve) (and (or (against ?v ?w) (against ?w ?v)) (open ?w)))))
    :effect (and (open ?v) (increase (total-cost) (effort ?v))))

  (:action shut
    :parameters (?v - (either small large))
    :precondition (open ?v)
    :effect (and (not (open ?v)) (increase (total-cost) 0.5)
                 (when (forall (?w - valve) (or (= ?w ?v) (not (open ?w)))) (not (pressure)))))

  (:action pump
    :precondition (exists (?l - large) (open ?l))
    :effect (and (pressure) (increase (total-cost) (once))))

  (:action rinse
    :parameters (?s - small ?l - large)
    :precondition (and (open ?s) (open ?l) (pressure))
    :effect (rinsed)))
