; Signals run along wires in steps: what is deleted and added at once stays, and conditions are those before.
(define (domain signals)
  (:requirements :adl)
  (:types node)
  (:constants source - node)
  (:predicates (on ?n - node) (wire ?a ?b - node) (stuck ?n - node))

  (:action step
    :effect (and (forall (?n - node) (when (not (stuck ?n)) (not (on ?n))))
                 (forall (?a ?b - node)
                   (when (and (on ?a) (wire ?a ?b) (not (stuck ?b))) (on ?b)))))

  (:action feed
    :parameters ()
    :precondition (not (stuck source))
    :effect (and (not (on source)) (on source)))

  (:action copy
    :parameters (?a ?b - node)
    :precondition (or (wire ?a ?b) (= ?a ?b))
    :effect (and (when (on ?a) (on ?b)) (when (not (on ?a)) (not (on ?b)))))

  (:action jam
    :parameters (?n - node)
    :precondition (and (on ?n) (not (stuck ?n)) (forall (?m - node) (imply (stuck ?m) (wire ?n ?m))))
    :effect (stuck ?n))

  (:action free
    :parameters (?n - node)
    :precondition (stuck ?n)
    :effect (and (not (stuck ?n)) (not (on ?n)))))
